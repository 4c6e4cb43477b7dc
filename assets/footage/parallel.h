// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <atomic>
#include <thread>
#include <vector>

namespace sigs::footage {

// Calls work(i) once for every i in 0..count-1 on all cores. Calls must not depend on each other.
template <class Work>
void parallel_rows(int count, const Work& work) {
  std::atomic<int> next{0};
  const auto run = [&] {
    for (int i = next++; i < count; i = next++) work(i);
  };
  std::vector<std::thread> threads;
  for (unsigned k = 1; k < std::max(1U, std::thread::hardware_concurrency()); ++k) threads.emplace_back(run);
  run();
  for (std::thread& thread : threads) thread.join();
}

}  // namespace sigs::footage
