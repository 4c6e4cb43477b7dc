// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "accuracy/dense.h"
#include "spline/trajectory.h"

namespace sigs::accuracy {

struct ExactMotion {
  Real3 position_m{0, 0, 0};
  Real3 velocity_mps{0, 0, 0};
};

// The natural cubic spline through the waypoints at a time within them, in long double, by a full matrix over the 64
// waypoints to either side: what a waypoint farther off changes is less than 2^-64 of what it is away, as influence
// halves at least from row to row (each row's middle is twice the sum of its neighbours).
[[nodiscard]] ExactMotion exact_motion(std::span<const TimedWaypoint> waypoints, double time_s);

// How the rows are written: as the formula of textbooks has them, or divided by h + k as engine/spline has them.
enum class Rows { textbook, divided };

// The matrix of the spline's accelerations for legs of these durations, natural ends.
[[nodiscard]] Dense spline_matrix(std::span<const Real> legs_s, Rows rows);

}  // namespace sigs::accuracy
