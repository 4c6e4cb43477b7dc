// SPDX-License-Identifier: MIT
#include "base/image.h"

#include <algorithm>

#include "base/ensure.h"

namespace sigs {

namespace {

struct Span {
  int first = 0;
  int past = 0;
};

// Clamped before the conversion to int: a box may be 1e9 px away.
Span touched(double first_edge, double length, int margin_px, int low, int high) {
  const double first = std::floor(first_edge + 0.5) - margin_px;
  const double past = std::ceil(first_edge + length + 0.5) + margin_px;
  return {static_cast<int>(std::clamp(first, double(low), double(high))),
          static_cast<int>(std::clamp(past, double(low), double(high)))};
}

}  // namespace

cv::Rect pixels_touched(const Box& box, int margin_px, const cv::Rect& bounds) {
  ENSURE(std::isfinite(box.x) && std::isfinite(box.y) && std::isfinite(box.width) && std::isfinite(box.height));
  const Span x = touched(box.x, box.width, margin_px, bounds.x, bounds.x + bounds.width);
  const Span y = touched(box.y, box.height, margin_px, bounds.y, bounds.y + bounds.height);
  if (x.past <= x.first || y.past <= y.first) return {};
  return {x.first, y.first, x.past - x.first, y.past - y.first};
}

}  // namespace sigs
