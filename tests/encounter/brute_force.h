// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace sigs::test {

// Random pairs of flights, straight, circling, recorded with and without velocities, and random volumes: the intervals
// of encounter_of() against the conditions themselves, by formulas of their own, at every 2 ms of 20 s.

struct BruteForce {
  int pairs = 0;
  int losses = 0;            // intervals found
  int brief_losses = 0;      // of them shorter than 20 ms
  long long instants = 0;    // that were compared
  double search_s = 0;       // run time of encounter_of() alone
  std::string disagreement;  // the first one; empty: none
};

// The first `pairs` of a fixed sequence. An instant agrees if both say the same or an end of an interval of
// encounter_of() is nearer than 0.5 ms; each end must be one by the conditions 0.5 ms before and after it.
[[nodiscard]] BruteForce brute_force(int pairs);

// For flights of the same kinds: with a radius that is wider than the least horizontal distance by 1e-3 and 1e-5 of it,
// there is a loss that has the moment of that distance, and each of its ends is on that radius; with one that is as
// much narrower there is none. Returns the first disagreement; empty: none.
[[nodiscard]] std::string grazes(int pairs);

}  // namespace sigs::test
