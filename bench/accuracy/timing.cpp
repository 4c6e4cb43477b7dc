// SPDX-License-Identifier: MIT
#include "accuracy/timing.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>

#include "base/ensure.h"

namespace sigs::accuracy {

double wall_s() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

double cpu_s() {
  std::timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

}  // namespace sigs::accuracy
