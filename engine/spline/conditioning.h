// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "spline/trajectory.h"

namespace sigs {

// How well waypoints and their times suit the interpolating spline. Where legs have very different durations, a short
// leg ends with a speed that carries the curve far away during the long leg that follows.

// The condition number of the interpolation: the greatest distance that the curve moves, anywhere between the first and
// the last waypoint, when each waypoint moves by at most 1 m (along one axis; each axis is a spline of its own). It is
// the Lebesgue constant of the natural cubic spline, the maximum of the sum of the magnitudes of its cardinal functions
// (de Boor, A Practical Guide to Splines, chapter II): 1 for one or two waypoints, 1.2 to 2 for even times, about 0.38
// times the ratio of two neighbouring durations where that ratio is large. Too small by 0.5 % at most, because it is
// evaluated at samples. Waypoints as for interpolating_spline(); positions do not matter. O(n).
[[nodiscard]] double interpolation_condition(std::span<const TimedWaypoint> waypoints);

// A leg on which the interpolating spline departs far from its waypoints.
struct Overshoot {
  std::size_t leg = 0;     // from waypoint `leg` to the next one
  double overshoot_m = 0;  // greatest distance of the curve from the straight line between the two
  double max_leg_m = 0;    // straight length of the longest of the leg and its two neighbours
};

// The legs with overshoot_m > max_leg_m, in order. Overshoots below a hundredth of the longest leg of all are left out.
// overshoot_m is evaluated at 64 moments of each leg, which makes it too small by 0.1 % at most.
[[nodiscard]] std::vector<Overshoot> overshoots_of(std::span<const TimedWaypoint> waypoints);

}  // namespace sigs
