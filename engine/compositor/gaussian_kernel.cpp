// SPDX-License-Identifier: MIT
#include "compositor/gaussian_kernel.h"

#include <cmath>

#include "base/ensure.h"

namespace sigs {

namespace {

// Variance of weights exp(-n^2 log_ratio) on all whole numbers n; up to a variance of 1, a dozen of them suffice.
double variance_of_samples(double log_ratio) {
  double sum = 0.5;
  double moment = 0;
  for (int n = 1; n <= 12; ++n) {
    const double weight = std::exp(-n * n * log_ratio);
    sum += weight;
    moment += n * n * weight;
  }
  return moment / sum;
}

// For the weights exp(-n^2 log_ratio) of the pixels n away whose variance is sigma^2. From one pixel on these are the
// Gaussian's own samples (to seven digits). A narrower Gaussian falls between the samples and would hardly blur at all:
// the one that is sampled has to be wider.
double log_ratio_for(double sigma_px) {
  if (sigma_px >= 1) return 0.5 / (sigma_px * sigma_px);
  constexpr int kHalvings = 60;
  double low = 0.5;
  double high = 100;  // a negligible blur
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = 0.5 * (low + high);
    (variance_of_samples(middle) > sigma_px * sigma_px ? low : high) = middle;
  }
  return low;
}

}  // namespace

int blur_margin_px(double sigma_px) {
  ENSURE(sigma_px >= 0 && sigma_px < 1e8);
  return static_cast<int>(std::ceil(3 * sigma_px));
}

cv::Mat sampled_gaussian(double sigma_px, int margin) {
  constexpr double kMinWeight = 1e-6;
  const double log_ratio = log_ratio_for(sigma_px);
  cv::Mat kernel(2 * margin + 1, 1, CV_64FC1);
  for (int n = -margin; n <= margin; ++n) {
    const double weight = std::exp(-n * n * log_ratio);
    kernel.at<double>(n + margin) = weight < kMinWeight ? 0 : weight;
  }
  kernel /= cv::sum(kernel)[0];
  kernel.convertTo(kernel, CV_32F);
  return kernel;
}

}  // namespace sigs
