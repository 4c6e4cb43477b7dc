// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>

namespace sigs {

// Runs from when it is made. For reports of time spent alone: no result may depend on it.
class Stopwatch {
 public:
  [[nodiscard]] double elapsed_s() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace sigs
