// SPDX-License-Identifier: MIT
#include "compositor/blur.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>

#include "base/ensure.h"
#include "compositor/blend.h"
#include "compositor/resample.h"
#include "video/color_space.h"

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

constexpr double kSamplesPerSigma = 4;

UniformGrid pixels_of(int first, int count) {
  return {.first = static_cast<double>(first), .step = 1, .count = count};
}

// Exactly sigma_px along an axis without spread.
glm::dvec2 remaining_sigma_px(double sigma_px, const glm::dvec2& spread_px2) {
  glm::dvec2 remaining_px(sigma_px);
  for (int axis = 0; axis < 2; ++axis)
    if (spread_px2[axis] > 0) remaining_px[axis] = std::sqrt(std::max(sigma_px * sigma_px - spread_px2[axis], 0.0));
  return remaining_px;
}

cv::Mat with_border(const cv::Mat& image, int across_px, int down_px) {
  cv::Mat out;
  cv::copyMakeBorder(image, out, down_px, down_px, across_px, across_px, cv::BORDER_CONSTANT, cv::Scalar::all(0));
  return out;
}

// Weights of a box, cut by the pixels' edges, at the shifts -m to m: 1 / length within, the rest at both ends.
// half[n] is the weight of the shifts n and -n.
//
// A box of the length l, 2 m - 1 <= l <= 2 m + 1, has the variance 2 (1 + 4 + .. + (m - 1)^2 + m^2 (l - 2 m + 1) / 2)
// / l on whole pixels; this is solved for l.
std::vector<double> half_of_box(double variance_px2) {
  double m = 1;
  while (m * (m + 1) / 3 < variance_px2) ++m;
  const double squares = (m - 1) * m * (2 * m - 1) / 3;
  const double length = (m * m * (2 * m - 1) - squares) / (m * m - variance_px2);
  std::vector<double> half(static_cast<std::size_t>(m) + 1, 1 / length);
  half.back() = (length - (2 * m - 1)) / 2 / length;
  return half;
}

glm::dvec2 shortened(const glm::dvec2& motion_px) {
  const double length_px = glm::length(motion_px);
  return length_px > kMaxMotion_px ? motion_px * (kMaxMotion_px / length_px) : motion_px;
}

// Floats of a row onto those of another, times weight.
void add_row(const float* from, float weight, int count, float* to) {
  for (int i = 0; i < count; ++i) to[i] += weight * from[i];
}

// Samples of image over rect at their places over target; 0 elsewhere.
cv::Mat moved_to(const cv::Mat& image, const cv::Rect& rect, const cv::Rect& target) {
  cv::Mat out = cv::Mat::zeros(target.size(), image.type());
  const cv::Rect both = rect & target;
  if (!both.empty()) image(both - rect.tl()).copyTo(out(both - target.tl()));
  return out;
}

// A row of floats (four to a pixel) blurred by a Gaussian, at the columns of `out`; beyond the row it repeats or is 0.
//   first  column of out's first pixel, counted in the row
void blur_row(const cv::Mat& row, bool repeats, double sigma_px, int first, cv::Mat out) {
  const int margin = static_cast<int>(std::min(std::ceil(3 * sigma_px), (repeats ? row.cols : 2 * out.cols) / 2.0));
  cv::Mat wide = cv::Mat::zeros(1, out.cols + 2 * margin, CV_32FC4);
  for (int x = 0; x < wide.cols; ++x) {
    const int from = first - margin + x;
    if (repeats)
      wide.at<cv::Vec4f>(x) = row.at<cv::Vec4f>(column_round(from, row.cols));
    else if (from >= 0 && from < row.cols)
      wide.at<cv::Vec4f>(x) = row.at<cv::Vec4f>(from);
  }
  const cv::Mat kernel = sampled_gaussian(sigma_px, margin);
  cv::filter2D(wide, wide, CV_32F, kernel.t(), {-1, -1}, 0, cv::BORDER_CONSTANT);
  wide.colRange(margin, margin + out.cols).copyTo(out);
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

double widening_at(const Lens& lens, double row) {
  if (!(lens.period_px() > 0)) return 1;
  const double f = lens.parameters().fy;
  return 1 / std::max(std::cos((row - lens.parameters().cy) / f), std::sin(0.5 / f));
}

Layer blurred_through(const Lens& lens, const Layer& layer, double sigma_px, const cv::Rect& image,
                      const glm::dvec2& spread_px2) {
  constexpr double kWidest_px = 300;  // beyond, nothing is recognised
  if (!(lens.period_px() > 0)) return blurred_within(layer, sigma_px, image, spread_px2);
  if (layer.empty()) return {};
  const glm::dvec2 sigma = remaining_sigma_px(std::min(sigma_px, kWidest_px), spread_px2);
  const Layer down = blurred(layer, glm::dvec2(0, sigma.y));
  const cv::Rect rows = down.rect & cv::Rect(down.rect.x, image.y, down.rect.width, image.height);
  if (rows.empty()) return {};
  const double widest = std::max(widening_at(lens, rows.y), widening_at(lens, rows.br().y - 1));
  const bool is_round = layer.rect.x <= image.x && layer.rect.br().x >= image.br().x;
  const int margin = static_cast<int>(std::min(std::ceil(3 * sigma.x * widest), image.width / 2.0));
  const cv::Rect target = cv::Rect(rows.x - margin, rows.y, rows.width + 2 * margin, rows.height) & image;
  if (target.empty()) return {};
  const int begin = is_round ? image.x : down.rect.x;  // of the columns that are blurred
  const int count = is_round ? image.width : down.rect.width;
  Layer out{target, cv::Mat(target.size(), CV_32FC4), coverage_over(target, layer)};
  for (int y = target.y; y < target.br().y; ++y) {
    const cv::Mat row = down.color.row(y - down.rect.y).colRange(begin - down.rect.x, begin - down.rect.x + count);
    const double sigma_x = sigma.x * widening_at(lens, y);
    cv::Mat to = out.color.row(y - target.y);
    if (is_round && sigma_x > count / 4.0)
      to.setTo(cv::mean(row));
    else
      blur_row(row, is_round, sigma_x, target.x - begin, to);
  }
  return out;
}

bool is_visible_after_blur(const Layer& layer, double sigma_px, const ColorInfo& footage, int bit_depth) {
  if (sigma_px <= kWideSigma_px) return true;
  const TransferFunction function = transfer_function_of(footage.transfer).value_or(TransferFunction::srgb);
  return max_after_blur(layer, sigma_px) >= min_light(function, bit_depth);
}

MotionKernel motion_kernel(const glm::dvec2& motion_px) {
  const double length_px = glm::length(motion_px);
  if (!std::isfinite(length_px) || length_px < kMinMotion_px) return {};
  const glm::dvec2 motion = shortened(motion_px);
  const bool is_across = std::abs(motion.x) >= std::abs(motion.y);
  const double major_px = is_across ? motion.x : motion.y;
  const double slope = (is_across ? motion.y : motion.x) / major_px;
  const std::vector<double> half = half_of_box(major_px * major_px / 12);
  const int m = static_cast<int>(half.size()) - 1;
  MotionKernel kernel;
  double spread_px2 = 0;
  const auto add = [&](int along, int beside, double weight) {
    if (!(weight > 0)) return;
    const cv::Point by_px = is_across ? cv::Point(along, beside) : cv::Point(beside, along);
    kernel.shifts.push_back({by_px, static_cast<float>(weight)});
    kernel.margin_px = {std::max(kernel.margin_px.width, std::abs(by_px.x)),
                        std::max(kernel.margin_px.height, std::abs(by_px.y))};
  };
  for (int n = -m; n <= m; ++n) {
    const double weight = half[static_cast<std::size_t>(std::abs(n))];
    const double first = std::floor(n * slope);
    const double share = n * slope - first;
    add(n, static_cast<int>(first), weight * (1 - share));
    add(n, static_cast<int>(first) + 1, weight * share);
    spread_px2 += weight * share * (1 - share);
  }
  kernel.spread_px2 = is_across ? glm::dvec2(0, spread_px2) : glm::dvec2(spread_px2, 0);
  return kernel;
}

Layer motion_blurred(const Layer& layer, const MotionKernel& kernel, const cv::Rect& bounds) {
  if (kernel.shifts.empty() || layer.empty()) return layer;
  const cv::Size& margin = kernel.margin_px;
  const cv::Rect target = cv::Rect(layer.rect.x - margin.width, layer.rect.y - margin.height,
                                   layer.rect.width + 2 * margin.width, layer.rect.height + 2 * margin.height) &
                          bounds;
  if (target.empty()) return {};
  Layer out{target, cv::Mat::zeros(target.size(), CV_32FC4), moved_to(layer.coverage, layer.rect, target)};
  for (const MotionKernel::Shift& shift : kernel.shifts) {
    const cv::Rect to = (layer.rect + shift.by_px) & target;
    for (int y = to.y; y < to.br().y; ++y)
      add_row(layer.color.ptr<float>(y - shift.by_px.y - layer.rect.y) + 4 * (to.x - shift.by_px.x - layer.rect.x),
              shift.weight, 4 * to.width, out.color.ptr<float>(y - target.y) + 4 * (to.x - target.x));
  }
  return out;
}

}  // namespace sigs
