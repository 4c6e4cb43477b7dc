// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "spline/piecewise_cubic.h"
#include "spline/trajectory.h"

namespace sigs {

// The cubic spline through every waypoint at its time: position, velocity and acceleration are continuous, and both
// ends are natural (no acceleration). Of all curves through the waypoints it has the least integral of acceleration
// squared (Holladay). One waypoint: hovers; two: a straight line at one speed. At least one; times strictly increasing.
// O(n).
[[nodiscard]] PiecewiseCubic interpolating_spline(std::span<const TimedWaypoint> waypoints);

}  // namespace sigs
