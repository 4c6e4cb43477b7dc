// SPDX-License-Identifier: MIT
#include "compositor/blur.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>

#include "base/ensure.h"
#include "compositor/gaussian_kernel.h"
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

// Exactly sigma_px along an axis without spread.
glm::dvec2 remaining_sigma_px(double sigma_px, const glm::dvec2& spread_px2) {
  glm::dvec2 remaining_px(sigma_px);
  for (int axis = 0; axis < 2; ++axis)
    if (spread_px2[axis] > 0) remaining_px[axis] = std::sqrt(std::max(sigma_px * sigma_px - spread_px2[axis], 0.0));
  return remaining_px;
}

cv::Rect grown(const cv::Rect& rect, int by_px) {
  return {rect.x - by_px, rect.y - by_px, rect.width + 2 * by_px, rect.height + 2 * by_px};
}

cv::Mat with_border(const cv::Mat& image, int across_px, int down_px) {
  cv::Mat out;
  cv::copyMakeBorder(image, out, down_px, down_px, across_px, across_px, cv::BORDER_CONSTANT, cv::Scalar::all(0));
  return out;
}

}  // namespace

Layer blurred(const Layer& layer, double sigma_px) {
  return blurred(layer, glm::dvec2(sigma_px));
}

Layer blurred(const Layer& layer, const glm::dvec2& sigma_px) {
  const int across = blur_margin_px(sigma_px.x);
  const int down = blur_margin_px(sigma_px.y);
  if ((across == 0 && down == 0) || layer.empty()) return layer;
  const cv::Rect rect(layer.rect.x - across, layer.rect.y - down, layer.rect.width + 2 * across,
                      layer.rect.height + 2 * down);
  Layer out{rect, with_border(layer.color, across, down), with_border(layer.coverage, across, down)};
  cv::sepFilter2D(out.color, out.color, CV_32F, sampled_gaussian(sigma_px.x, across),
                  sampled_gaussian(sigma_px.y, down), {-1, -1}, 0, cv::BORDER_CONSTANT);
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

Layer blurred_within(const Layer& layer, double sigma_px, const cv::Rect& image, const glm::dvec2& spread_px2) {
  if (sigma_px <= kWideSigma_px) return clipped(blurred(layer, remaining_sigma_px(sigma_px, spread_px2)), image);
  constexpr double kUnbounded_px = 1e6;
  const int margin_px = static_cast<int>(std::min(std::ceil(3 * sigma_px), kUnbounded_px));
  return widely_blurred(layer, sigma_px, grown(layer.rect, margin_px) & image);
}

bool is_visible_after_blur(const Layer& layer, double sigma_px, const ColorInfo& footage, int bit_depth) {
  if (sigma_px <= kWideSigma_px) return true;
  const TransferFunction function = transfer_function_of(footage.transfer).value_or(TransferFunction::srgb);
  return max_after_blur(layer, sigma_px) >= min_light(function, bit_depth);
}

}  // namespace sigs
