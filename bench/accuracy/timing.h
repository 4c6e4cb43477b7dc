// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

namespace sigs::accuracy {

// Seconds since some moment: of the clock on the wall, and of all this process' threads.
[[nodiscard]] double wall_s();
[[nodiscard]] double cpu_s();

// Wall seconds of one call among `calls`, as the minimum of `rounds` rounds: for work without randomness.
template <class Function>
[[nodiscard]] double min_s(int rounds, double calls, const Function& function) {
  double minimum = 1e300;
  for (int round = 0; round < rounds; ++round) {
    const double start = wall_s();
    function();
    const double taken = (wall_s() - start) / calls;
    minimum = taken < minimum ? taken : minimum;
  }
  return minimum;
}

}  // namespace sigs::accuracy
