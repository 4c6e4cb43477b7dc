// SPDX-License-Identifier: MIT
#include "editor/views/timeline/lane_values.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace sigs::editor {

namespace {

constexpr double kFinestColumn_px = 2;
constexpr float kTolerance_px = 0.33F;
constexpr double kNearZero = 0.4;  // of the highest value

// Drops points that lie on the line between those that stay. Points ascend in x.
Polyline simplified(const Polyline& points) {
  if (points.size() < 3) return points;
  constexpr float kSteep = std::numeric_limits<float>::max();
  Polyline kept{points.front()};
  float lowest = -kSteep;  // slopes from the last kept point that pass by all points since
  float highest = kSteep;
  for (std::size_t i = 1; i < points.size(); ++i) {
    const auto slope_to = [&](float dy) {
      return (points[i].y + dy - kept.back().y) / std::max(1e-4F, points[i].x - kept.back().x);
    };
    if (slope_to(0) < lowest || slope_to(0) > highest) {
      kept.push_back(points[i - 1]);
      lowest = -kSteep;
      highest = kSteep;
    }
    lowest = std::max(lowest, slope_to(-kTolerance_px));
    highest = std::min(highest, slope_to(kTolerance_px));
  }
  kept.push_back(points.back());
  return kept;
}

// Collects points, and starts another line after a gap.
class Lines {
 public:
  void add(double x, double y) { line_.emplace_back(static_cast<float>(x), static_cast<float>(y)); }
  void gap() {
    if (!line_.empty()) lines_.push_back(simplified(line_));
    line_.clear();
  }
  [[nodiscard]] std::vector<Polyline> taken() {
    gap();
    return std::move(lines_);
  }

 private:
  Polyline line_;
  std::vector<Polyline> lines_;
};

}  // namespace

double LaneScale::share_of(double value) const {
  const auto shaped = [&](double v) { return scaling == Scaling::logarithmic ? std::log1p(std::max(0.0, v)) : v; };
  const double span = shaped(high) - shaped(low);
  return span > 0 ? std::clamp((shaped(value) - shaped(low)) / span, 0.0, 1.0) : 0.5;
}

LaneScale scale_for(std::span<const double> values, double min_span, Scaling scaling) {
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (const double value : values) {
    if (!std::isfinite(value)) continue;
    low = std::min(low, value);
    high = std::max(high, value);
  }
  if (low > high) return {.low = 0, .high = min_span, .scaling = scaling};
  if (low >= 0 && low < kNearZero * high) low = 0;
  const double span = std::max(high - low, min_span);
  const double middle = std::midpoint(low, high);
  const double margin = 0.06 * span;
  if (low == 0 && high >= 0) return {.low = 0, .high = std::max(high + margin, min_span), .scaling = scaling};
  return {.low = middle - span / 2 - margin, .high = middle + span / 2 + margin, .scaling = scaling};
}

std::vector<Polyline> curve_of(std::span<const double> values, int first_frame, const TimeRuler& ruler,
                               const LaneScale& scale, const LaneBox& box) {
  if (values.empty() || !(ruler.width > 0) || !(ruler.count > 0)) return {};
  const auto size = static_cast<double>(values.size());
  const double from = std::clamp(std::floor(ruler.first) - 1 - first_frame, 0.0, size);
  const double to = std::clamp(std::ceil(ruler.first + ruler.count) + 1 - first_frame, 0.0, size);
  const auto y_of = [&](double value) { return box.top_y + (1 - scale.share_of(value)) * box.height; };
  const auto x_of = [&](std::size_t i) { return ruler.x_of(first_frame + static_cast<double>(i) + 0.5); };
  // Columns of whole frames, the same ones however the strip is panned, or the curve would crawl.
  const auto stride = static_cast<std::size_t>(std::max(1.0, std::ceil(kFinestColumn_px * ruler.count / ruler.width)));
  Lines lines;
  for (std::size_t i = static_cast<std::size_t>(from) / stride * stride; i < static_cast<std::size_t>(to);
       i += stride) {
    const auto column = values.subspan(i, std::min(stride, values.size() - i));
    if (!std::all_of(column.begin(), column.end(), [](double v) { return std::isfinite(v); })) {
      lines.gap();
      continue;
    }
    const auto [low, high] = std::minmax_element(column.begin(), column.end());
    const auto first = std::min(low, high);
    const auto second = std::max(low, high);
    lines.add(x_of(i + static_cast<std::size_t>(first - column.begin())), y_of(*first));
    if (first != second) lines.add(x_of(i + static_cast<std::size_t>(second - column.begin())), y_of(*second));
  }
  return lines.taken();
}

}  // namespace sigs::editor
