// SPDX-License-Identifier: MIT
#include "compositor/motion_blur.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace sigs {

namespace {

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

}  // namespace

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
