// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <thread>

namespace sigs::test {

// Waits until the condition is true, three minutes at most; whether it came true. For states that another thread
// reaches.
template <class Condition>
bool comes_true(Condition condition) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(3);
  while (std::chrono::steady_clock::now() < end) {
    if (condition()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  return false;
}

}  // namespace sigs::test
