// SPDX-License-Identifier: MIT
#pragma once

#include <variant>
#include <vector>

#include "spline/constant_speed.h"
#include "spline/motion.h"
#include "spline/piecewise_cubic.h"

namespace sigs {

// A curve together with how it is timed: the curve's own timing, or one speed.
using TimedCurve = std::variant<PiecewiseCubic, ConstantSpeed>;

[[nodiscard]] inline Motion motion_at(const TimedCurve& timed_curve, double time_s) {
  return std::visit([time_s](const auto& timed) { return timed.motion_at(time_s); }, timed_curve);
}

[[nodiscard]] inline std::vector<double> sample_times_s(const TimedCurve& timed_curve, int per_piece) {
  return std::visit([per_piece](const auto& timed) { return timed.sample_times_s(per_piece); }, timed_curve);
}

[[nodiscard]] inline std::size_t piece_count(const TimedCurve& timed_curve) {
  return std::visit([](const auto& timed) { return timed.knots_s().size() - 1; }, timed_curve);
}

}  // namespace sigs
