// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>

namespace sigs::distortion {

struct ValueAndSlope {
  double value = 0;
  double slope = 0;
};

// The x in [0, highest] at which an increasing function takes a value; nothing where it does not get so far.
// f: double -> ValueAndSlope, with f(0) = 0 and slope 1 there. Newton's method; a step that leaves the bracket in which
// the answer is known to lie is replaced by halving it, so it always ends.
template <class Function>
[[nodiscard]] std::optional<double> increasing_inverse(const Function& f, double value, double highest) {
  if (!(value >= 0 && value <= f(highest).value)) return std::nullopt;
  double low = 0;
  double high = highest;
  double x = std::min(value, highest);
  constexpr int kMaxSteps = 400;  // halving a bracket of any doubles takes fewer
  for (int step = 0; step < kMaxSteps; ++step) {
    const auto [y, slope] = f(x);
    if (y == value) return x;
    (y < value ? low : high) = x;
    double next = x - (y - value) / slope;
    if (!(next > low && next < high)) next = std::midpoint(low, high);
    if (std::abs(next - x) <= std::numeric_limits<double>::epsilon() * x) return next;
    x = next;
  }
  return x;
}

}  // namespace sigs::distortion
