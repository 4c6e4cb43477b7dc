// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>

#include "base/image.h"

namespace sigs {

// Intersection over union (Jaccard index) of the areas of two boxes, 0 to 1. 0 where they do not intersect or one has
// no area.
[[nodiscard]] inline double overlap(const Box& a, const Box& b) {
  const double width = std::min(a.x + a.width, b.x + b.width) - std::max(a.x, b.x);
  const double height = std::min(a.y + a.height, b.y + b.height) - std::max(a.y, b.y);
  if (!(width > 0 && height > 0)) return 0;
  const double both = width * height;
  const double either = a.width * a.height + b.width * b.height - both;
  return std::clamp(both / either, 0.0, 1.0);  // either > 0: it is at least the larger area
}

// Whether value is greater than threshold by more than 1e-9, so that rounding of decimals does not matter: 5 px may be
// stored as 5.000000000000001.
[[nodiscard]] inline bool exceeds(double value, double threshold) {
  constexpr double kRounding = 1e-9;
  return value > threshold + kRounding;
}

}  // namespace sigs
