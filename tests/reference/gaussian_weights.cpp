// SPDX-License-Identifier: MIT
#include "reference/gaussian_weights.h"

#include <cmath>
#include <numbers>

namespace sigs::truth {
namespace {

// Share of a Gaussian below z sigmas.
double below(double z) {
  return 0.5 * std::erfc(-z / std::numbers::sqrt2);
}

}  // namespace

GaussianWeights to_pixels(double x_px, double sigma_px) {
  const int middle = static_cast<int>(std::floor(x_px + 0.5));
  if (sigma_px == 0) return {middle, {1.0}};
  const int reach = static_cast<int>(std::ceil(kReachOfBlur * sigma_px));
  GaussianWeights spread{middle - reach, {}};
  double lower = 0;
  for (int i = middle - reach; i <= middle + reach; ++i) {
    const double upper = i == middle + reach ? 1.0 : below((i + 0.5 - x_px) / sigma_px);
    spread.weights.push_back(upper - lower);
    lower = upper;
  }
  return spread;
}

GaussianWeights to_nodes(double x_px, double sigma_px, double step_px) {
  const int first = static_cast<int>(std::ceil((x_px - kReachOfBlur * sigma_px) / step_px));
  const int last = static_cast<int>(std::floor((x_px + kReachOfBlur * sigma_px) / step_px));
  GaussianWeights spread{first, {}};
  for (int k = first; k <= last; ++k) {
    const double z = (k * step_px - x_px) / sigma_px;
    spread.weights.push_back(std::exp(-z * z / 2) / (sigma_px * std::sqrt(2 * std::numbers::pi)));
  }
  return spread;
}

}  // namespace sigs::truth
