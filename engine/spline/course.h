// SPDX-License-Identifier: MIT
#pragma once

#include <variant>
#include <vector>

#include "spline/constant_speed.h"
#include "spline/motion.h"
#include "spline/piecewise_cubic.h"

namespace sigs {

// A curve together with how it is walked: the curve's own timing, or one speed.
using Course = std::variant<PiecewiseCubic, ConstantSpeed>;

[[nodiscard]] inline Motion motion_at(const Course& course, double time_s) {
  return std::visit([time_s](const auto& timed) { return timed.motion_at(time_s); }, course);
}

[[nodiscard]] inline std::vector<double> sample_times_s(const Course& course, int per_piece) {
  return std::visit([per_piece](const auto& timed) { return timed.sample_times_s(per_piece); }, course);
}

[[nodiscard]] inline std::size_t piece_count(const Course& course) {
  return std::visit([](const auto& timed) { return timed.knots_s().size() - 1; }, course);
}

}  // namespace sigs
