// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

#include "base/thread.h"

namespace sigs {

// Calls work(i) for 0 <= i < count, up to `threads` of them at a time, fewer where the system gives no more threads,
// each i once. What the work throws is thrown on, once all that had begun is done; nothing more is begun.
template <class Work>
void parallel_for(int count, int threads, const Work& work) {
  std::atomic<int> next{0};
  std::mutex mutex;
  std::exception_ptr thrown;
  const auto run = [&] {
    try {
      for (int i = next++; i < count; i = next++) work(i);
    } catch (...) {
      next = count;
      const std::lock_guard lock(mutex);
      if (!thrown) thrown = std::current_exception();
    }
  };
  std::vector<std::thread> others;
  others.reserve(static_cast<std::size_t>(std::max(0, std::min(threads, count) - 1)));
  while (others.size() < others.capacity()) {
    Result<std::thread> other = started_thread(run);
    if (!other) break;
    others.push_back(std::move(*other));
  }
  run();
  for (std::thread& other : others) other.join();
  if (thrown) std::rethrow_exception(thrown);
}

}  // namespace sigs
