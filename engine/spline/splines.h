// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <span>

#include "spline/piecewise_cubic.h"
#include "spline/trajectory.h"

namespace sigs {

// The two kinds of spline through or near waypoints. Waypoints: at least one, times strictly increasing.

// The cubic spline through each waypoint at its time. Position, velocity and acceleration are continuous, and both ends
// are natural (no acceleration). Of all curves through the waypoints it has the smallest integral of the squared
// acceleration (Holladay 1957). One waypoint hovers; two give a straight line at one speed. O(n).
[[nodiscard]] PiecewiseCubic interpolating_spline(std::span<const TimedWaypoint> waypoints);

// The uniform cubic B-spline of the paper, equations (1) and (2): X(t) = sum of B_i,3(t) P_i for 3 <= t <= n + 1, where
// the n + 1 waypoints are the control points P_i and the knots are t = 0, 1, 2, ... The curve stays near the waypoints
// and inside their convex hull. In general it passes through none of them; it begins near the second one and ends near
// the last but one.
// Time: t = 3 at the first waypoint's time and t = n + 1 at the last one's, linear in between. The times of the other
// waypoints are not used.
// Equation (1) needs four waypoints. Two or three get reflected neighbours, 2 P_0 - P_1 before the first one and
// likewise after the last one, so that the curve begins and ends at the waypoints; two give the straight line. One
// hovers.
[[nodiscard]] PiecewiseCubic approximating_spline(std::span<const TimedWaypoint> waypoints);

// The basis of the uniform cubic B-spline, equation (2) of the paper, with the factor 1/(6 h^3), for which the basis
// functions sum to one. (With the printed factor 1/h their sum is 6 h^2.)

// The four polynomials of one basis function, from its first knot to its fifth. Row j contains the coefficients of 1,
// x, x^2, x^3 between knot j and knot j + 1, where x = (t - knot j) / h runs from 0 to 1.
inline constexpr std::array<std::array<double, 4>, 4> kCubicBasisPieces{{
    {0, 0, 0, 1.0 / 6},
    {1.0 / 6, 3.0 / 6, 3.0 / 6, -3.0 / 6},
    {4.0 / 6, 0, -6.0 / 6, 3.0 / 6},
    {1.0 / 6, -3.0 / 6, 3.0 / 6, -1.0 / 6},
}};

// Value at t of the basis function with the support [first_knot, first_knot + 4 h]; 0 outside it. h > 0.
[[nodiscard]] double cubic_basis(double t, double first_knot, double h);

}  // namespace sigs
