// SPDX-License-Identifier: MIT
#include "evaluation/overlap.h"

#include <algorithm>

namespace sigs {

namespace {

double common_length(double a_low, double a_length, double b_low, double b_length) {
  return std::min(a_low + a_length, b_low + b_length) - std::max(a_low, b_low);
}

}  // namespace

double overlap(const Box& a, const Box& b) {
  const double width = common_length(a.x, a.width, b.x, b.width);
  const double height = common_length(a.y, a.height, b.y, b.height);
  if (!(width > 0 && height > 0)) return 0;
  const double both = width * height;
  const double either = a.width * a.height + b.width * b.height - both;
  return std::clamp(both / either, 0.0, 1.0);  // either > 0: it is at least the larger area
}

bool exceeds(double value, double threshold) {
  constexpr double kRounding = 1e-9;
  return value > threshold + kRounding;
}

}  // namespace sigs
