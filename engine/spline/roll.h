// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

namespace sigs {

// A desired roll at one moment, up to whole turns, and how much it is worth (0: not at all).
struct DesiredRoll {
  double time_s = 0;
  double roll_rad = 0;
  double weight = 0;
};

// Roll at each desired roll's time: the one function that least departs from the desired rolls and least turns, the
// minimum of
//   sum weight (roll - desired roll)^2 dt + tau^2 (d roll / dt)^2 dt,  tau = 0.15 s.
// It follows a steady or steadily growing desired roll exactly, rounds sudden changes over some 0.15 s, and goes
// linearly over stretches without weight. Whole turns are chosen so that each desired roll is the nearest to the one
// before it that is worth anything; none that is: 0 throughout. Times strictly increasing. O(n).
[[nodiscard]] std::vector<double> smoothed_roll_rad(std::span<const DesiredRoll> desired_rolls);

}  // namespace sigs
