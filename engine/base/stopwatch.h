// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>

namespace sigs {

// Measures the seconds since its construction. For reports of durations only: no result may depend on it.
class Stopwatch {
 public:
  // Seconds since the construction, by the monotonic clock.
  [[nodiscard]] double elapsed_s() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace sigs
