// SPDX-License-Identifier: MIT
#include "editor/document/brush.h"

#include <algorithm>
#include <cmath>

#include "base/ensure.h"

namespace sigs::editor {

namespace {

bool is_finite(const glm::dvec2& p) {
  return std::isfinite(p.x) && std::isfinite(p.y);
}

double distance_to_line(const glm::dvec2& p, const glm::dvec2& from, const glm::dvec2& along, double length_squared) {
  const double share = length_squared > 0 ? std::clamp(glm::dot(p - from, along) / length_squared, 0.0, 1.0) : 0;
  return glm::length(p - from - share * along);
}

// Whole pixels within a reach of a stretch, of `count` of them. Far away, double keeps what int cannot hold.
cv::Range within(double low, double high, double reach, int count) {
  const double first = std::clamp(std::ceil(low - reach), 0.0, static_cast<double>(count));
  const double last = std::clamp(std::floor(high + reach) + 1, first, static_cast<double>(count));
  return {static_cast<int>(first), static_cast<int>(last)};
}

// The columns of a row that the brush can reach: of a long slanting line a small part.
cv::Range columns_of_row(int row, const glm::dvec2& from, const glm::dvec2& along, double reach, int count) {
  double first = 0;
  double last = 1;
  if (along.y != 0) {
    const double one = (row - reach - from.y) / along.y;
    const double other = (row + reach - from.y) / along.y;
    first = std::clamp(std::min(one, other), 0.0, 1.0);
    last = std::clamp(std::max(one, other), 0.0, 1.0);
  }
  const double one_x = from.x + first * along.x;
  const double other_x = from.x + last * along.x;
  return within(std::min(one_x, other_x), std::max(one_x, other_x), reach, count);
}

}  // namespace

double covered(const Brush& brush, double distance_px) {
  if (!(brush.edge_px > 0)) return distance_px <= brush.radius_px ? 1 : 0;
  return std::clamp((brush.radius_px - distance_px) / brush.edge_px + 0.5, 0.0, 1.0);
}

cv::Rect move_brush(cv::Mat& mask, const Brush& brush, const glm::dvec2& from, const glm::dvec2& to) {
  ENSURE(mask.type() == CV_8UC1);
  if (!is_finite(from) || !is_finite(to)) return {};
  const double reach = brush.radius_px + std::max(0.0, brush.edge_px) / 2;
  const glm::dvec2 along = to - from;
  const double length_squared = glm::dot(along, along);
  const cv::Range rows = within(std::min(from.y, to.y), std::max(from.y, to.y), reach, mask.rows);
  const cv::Range columns = within(std::min(from.x, to.x), std::max(from.x, to.x), reach, mask.cols);
  if (rows.empty() || columns.empty()) return {};
  for (int y = rows.start; y < rows.end; ++y) {
    uchar* const line = mask.ptr<uchar>(y);
    const cv::Range part = columns_of_row(y, from, along, reach, mask.cols);
    for (int x = part.start; x < part.end; ++x) {
      const double distance_px = distance_to_line({x, y}, from, along, length_squared);
      const auto share = static_cast<uchar>(std::lround(255 * covered(brush, distance_px)));
      line[x] = brush.erases ? std::min(line[x], static_cast<uchar>(255 - share)) : std::max(line[x], share);
    }
  }
  return {columns.start, rows.start, columns.size(), rows.size()};
}

double stepped_radius_px(double radius_px, int steps) {
  constexpr double kStep = 1.15;
  const double wanted = radius_px * std::pow(kStep, steps);
  // At least half a pixel a step: small brushes would hardly change.
  const double minimum = radius_px + 0.5 * steps;
  return std::clamp(steps > 0 ? std::max(wanted, minimum) : std::min(wanted, minimum), kMinRadius_px, kMaxRadius_px);
}

}  // namespace sigs::editor
