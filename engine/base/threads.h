// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <atomic>
#include <exception>
#include <functional>
#include <mutex>
#include <string>
#include <thread>
#include <type_traits>
#include <utility>
#include <vector>

#include "base/result.h"

namespace sigs {

// Threads and exceptions as values. No exception may leave a thread, so each thread's body is one call of guarded().
// BoundedQueue (base/bounded_queue.h) takes items from one thread to another.

// Runs the job and returns the Result that it returns. An exception that it throws comes back as an error, as
// thrown_error() describes it.
//   where  the `where` of that error
template <class Job>
[[nodiscard]] std::invoke_result_t<Job&> guarded(Job&& job, const std::string& where = {});

// The exception being handled, as an error; call it in a catch clause only. The kind is `unavailable` for memory that
// cannot be had and for threads that cannot be started (OpenCV's included), and for libraries that cannot be loaded
// (image_codecs.h); bad_data for everything else.
//   where  the `where` of that error
[[nodiscard]] Error thrown_error(const std::string& where = {});

// Whether the exception being handled reports that there is no more memory; call it in a catch clause only.
[[nodiscard]] bool is_out_of_memory();

// Starts a thread, which the caller has to join. The body must not throw (see guarded()). Error unavailable: the system
// grants no more threads, or no memory for one; then nothing was started.
[[nodiscard]] Result<std::thread> started_thread(std::function<void()> body);

// The same for a body that may throw: on_error is called, on the thread, with what it throws (see thrown_error()).
[[nodiscard]] Result<std::thread> started_thread(std::function<void()> body,
                                                 std::function<void(const Error&)> on_error);

// Runs the body on a thread that nobody joins, or here where the system grants no more threads. The body must not
// throw.
void run_in_background(const std::function<void()>& body);

// Calls work(i) once for each i with 0 <= i < count, on up to `threads` threads, this one included, and returns when
// all calls have returned. Uses fewer threads where the system grants no more. When a call throws, no further call
// begins, and the first exception is thrown again here once the calls that had begun have returned.
template <class Work>
void parallel_for(int count, int threads, const Work& work);

// --- Templates.

template <class Job>
std::invoke_result_t<Job&> guarded(Job&& job, const std::string& where) {
  try {
    return job();
  } catch (...) {
    return fail(thrown_error(where));
  }
}

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
