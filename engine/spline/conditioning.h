// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "spline/trajectory.h"

namespace sigs {

// How stiff waypoints are for the interpolating spline: legs of very different durations pass a speed from one to the
// next that the next has all its time to be carried away by.

// Condition number of the interpolation: how far the curve moves at most, anywhere between the first and the last
// waypoint, when every waypoint moves by at most 1 m (along one axis; each axis is a spline of its own). It is the
// Lebesgue constant of the natural cubic spline, the greatest sum of the magnitudes of its cardinal functions (de Boor,
// A Practical Guide to Splines, chapter II): 1 for one or two waypoints, 1.2 to 2 for even times, some 0.38 times the
// ratio of two neighbouring durations where that is large. From below, to 0.5 %. Waypoints as for
// interpolating_spline(); positions do not matter. O(n).
[[nodiscard]] double interpolation_condition(std::span<const TimedWaypoint> waypoints);

// A leg on which the interpolating spline leaves its waypoints far behind.
struct Overshoot {
  std::size_t leg = 0;     // from waypoint `leg` to the one after
  double overshoot_m = 0;  // greatest distance of the curve from the straight way between the two
  double max_leg_m = 0;    // straight length of the longest of the leg and its two neighbours
};

// The legs with overshoot_m > max_leg_m, in order, save overshoots below a hundredth of the longest leg of all.
// overshoot_m is looked for at 64 moments of each leg: from below, to 0.1 %.
[[nodiscard]] std::vector<Overshoot> overshoots_of(std::span<const TimedWaypoint> waypoints);

}  // namespace sigs
