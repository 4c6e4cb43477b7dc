// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "spline/piecewise_cubic.h"
#include "spline/trajectory.h"

namespace sigs {

// The uniform cubic B-spline of the paper, equations (1) and (2): X(t) = sum of B_i,3(t) P_i for 3 <= t <= n + 1, with
// the n + 1 waypoints as control points P_i and knots at t = 0, 1, 2, ... The curve keeps near the waypoints and inside
// their convex hull, passes through none of them in general, and begins near the second and ends near the last but one.
// Time: t = 3 at the first waypoint's time and t = n + 1 at the last one's, linear in between. The times of the
// waypoints in between are not used. Equation (1) needs four waypoints. Two or three are given reflected neighbours, 2
// P_0 - P_1 before the first and likewise after the last, so that the curve begins and ends at them; two make the
// straight line. One: hovers.
[[nodiscard]] PiecewiseCubic approximating_spline(std::span<const TimedWaypoint> waypoints);

}  // namespace sigs
