// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <atomic>
#include <system_error>
#include <thread>
#include <vector>

namespace sigs {

// Calls work(i) for 0 <= i < count, up to `threads` of them at a time, each i once.
template <class Work>
void side_by_side(int count, int threads, const Work& work) {
  std::atomic<int> next{0};
  const auto run = [&] {
    for (int i = next++; i < count; i = next++) work(i);
  };
  std::vector<std::thread> others;
  try {
    for (int t = 1; t < std::min(threads, count); ++t) others.emplace_back(run);
  } catch (const std::system_error&) {  // the system gives no more of them: fewer do the same
  }
  run();
  for (std::thread& other : others) other.join();
}

}  // namespace sigs
