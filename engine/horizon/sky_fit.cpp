// SPDX-License-Identifier: MIT
#include "horizon/cloud_map.h"

namespace sigs {

SkyTerms sky_terms(double u, double v) {
  return {1, u, v, u * u, u * v, v * v, v * v * v, v * v * v * v};
}

double value_of(const SkyTerms& fit, const SkyTerms& terms) {
  double sum = 0;
  for (std::size_t i = 0; i < fit.size(); ++i) sum += fit[i] * terms[i];
  return sum;
}

SkyTerms fitted(const std::vector<SkyPlace>& samples, const std::function<double(const SkyPlace&)>& value,
                const std::function<double(const SkyPlace&)>& weight) {
  constexpr double kHeld = 1e-3, kHeldAcross = 0.1;  // the latter as a share of all weights
  constexpr int n = kSkyTerms;
  cv::Matx<double, n, n> normal = cv::Matx<double, n, n>::eye() * kHeld;
  cv::Matx<double, n, 1> right = cv::Matx<double, n, 1>::zeros();
  double weights = 0;
  for (const SkyPlace& sample : samples) {
    const double w = weight(sample);
    if (w <= 0) continue;
    weights += w;
    const double wanted = value(sample);
    for (int i = 0; i < n; ++i) {
      const double term = w * sample.terms[static_cast<std::size_t>(i)];
      right(i) += term * wanted;
      for (int j = 0; j <= i; ++j) normal(i, j) += term * sample.terms[static_cast<std::size_t>(j)];
    }
  }
  for (const int across : {1, 3, 4}) normal(across, across) += kHeldAcross * weights;
  for (int i = 0; i < n; ++i)
    for (int j = i + 1; j < n; ++j) normal(i, j) = normal(j, i);
  const cv::Matx<double, n, 1> solved = normal.solve(right, cv::DECOMP_CHOLESKY);
  SkyTerms fit;
  for (int i = 0; i < n; ++i) fit[static_cast<std::size_t>(i)] = solved(i);
  return fit;
}

SkyTerms bluest(const std::vector<SkyPlace>& samples) {
  constexpr double kExpectile = 0.97;
  constexpr int kRounds = 20;  // which it needs to settle
  const auto saturation = [](const SkyPlace& sample) { return sample.saturation; };
  SkyTerms fit = fitted(samples, saturation, [](const SkyPlace&) { return 1.0; });
  for (int round = 0; round < kRounds; ++round) {
    const SkyTerms last = fit;
    fit = fitted(samples, saturation, [&](const SkyPlace& sample) {
      return sample.saturation > value_of(last, sample.terms) ? kExpectile : 1 - kExpectile;
    });
  }
  return fit;
}

}  // namespace sigs
