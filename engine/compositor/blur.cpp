// SPDX-License-Identifier: MIT
#include "compositor/blur.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>

#include "base/ensure.h"
#include "compositor/occlude.h"
#include "compositor/resample.h"
#include "video/color_space.h"

namespace sigs {

namespace {

constexpr double kSamplesPerSigma = 4;

UniformGrid pixels_of(int first, int count) {
  return {.first = static_cast<double>(first), .step = 1, .count = count};
}

// Samples within target keep their positions; beyond the layer everything is empty.
cv::Mat coverage_over(const cv::Rect& target, const Layer& layer) {
  cv::Mat coverage = cv::Mat::zeros(target.size(), CV_32FC1);
  const cv::Rect both = target & layer.rect;
  if (!both.empty()) layer.coverage(both - layer.rect.tl()).copyTo(coverage(both - target.tl()));
  return coverage;
}

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

// One axis of the kernel, 2 reach + 1 samples that sum to one. Weights too small to change an 8-bit sample are 0: a
// blur of negligible width changes no neighbour.
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

cv::Rect grown(const cv::Rect& rect, int by_px) {
  return {rect.x - by_px, rect.y - by_px, rect.width + 2 * by_px, rect.height + 2 * by_px};
}

cv::Mat with_border(const cv::Mat& image, int width_px) {
  cv::Mat out;
  cv::copyMakeBorder(image, out, width_px, width_px, width_px, width_px, cv::BORDER_CONSTANT, cv::Scalar::all(0));
  return out;
}

}  // namespace

int blur_margin_px(double sigma_px) {
  ENSURE(sigma_px >= 0 && sigma_px < 1e8);
  return static_cast<int>(std::ceil(3 * sigma_px));
}

Layer blurred(const Layer& layer, double sigma_px) {
  const int margin = blur_margin_px(sigma_px);
  if (margin == 0 || layer.empty()) return layer;
  Layer out{grown(layer.rect, margin), with_border(layer.color, margin), with_border(layer.coverage, margin)};
  const cv::Mat kernel = sampled_gaussian(sigma_px, margin);
  cv::sepFilter2D(out.color, out.color, CV_32F, kernel, kernel, {-1, -1}, 0, cv::BORDER_CONSTANT);
  return out;
}

Layer widely_blurred(const Layer& layer, double sigma_px, const cv::Rect& target) {
  ENSURE(sigma_px >= kWideSigma_px);
  if (layer.empty() || target.empty()) return {};
  const double sample_step_px = sigma_px / kSamplesPerSigma;
  const double kernel_px =
      std::sqrt(sigma_px * sigma_px - splined_variance(sample_step_px));  // the spline adds its own variance
  const double radius_px = std::ceil(3 * sigma_px) + 0.5;                 // the extent of blurred(), in whole pixels
  const UniformGrid down = uniform_grid_for(target.y, target.height, sample_step_px);
  const UniformGrid across = uniform_grid_for(target.x, target.width, sample_step_px);
  const cv::Mat samples =
      resampled(layer.color, gaussian_taps(down, pixels_of(layer.rect.y, layer.rect.height), kernel_px, radius_px),
                gaussian_taps(across, pixels_of(layer.rect.x, layer.rect.width), kernel_px, radius_px));
  return {target,
          resampled(samples, spline_taps(target.y, target.height, down), spline_taps(target.x, target.width, across)),
          coverage_over(target, layer)};
}

double max_after_blur(const Layer& layer, double sigma_px) {
  if (layer.empty()) return 0;
  const cv::Scalar sum = cv::sum(layer.color);
  // The cut kernel is higher by 1 / 0.9973^2, and by 1 / 48 as it gives way to the spline.
  constexpr double kCut = 1.03;
  return kCut * std::max({sum[0], sum[1], sum[2], sum[3]}) / (2 * std::numbers::pi * sigma_px * sigma_px);
}

Layer blurred_within(const Layer& layer, double sigma_px, const cv::Rect& image) {
  if (sigma_px <= kWideSigma_px) return clipped(blurred(layer, sigma_px), image);
  constexpr double kUnbounded_px = 1e6;
  const int margin_px = static_cast<int>(std::min(std::ceil(3 * sigma_px), kUnbounded_px));
  return widely_blurred(layer, sigma_px, grown(layer.rect, margin_px) & image);
}

bool is_visible_after_blur(const Layer& layer, double sigma_px, const ColorInfo& footage) {
  if (sigma_px <= kWideSigma_px) return true;
  const TransferFunction function = transfer_function_of(footage.transfer).value_or(TransferFunction::srgb);
  return max_after_blur(layer, sigma_px) >= min_light(function);
}

}  // namespace sigs
