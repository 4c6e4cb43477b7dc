// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <deque>
#include <exception>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <type_traits>
#include <utility>
#include <vector>

#include "base/result.h"

namespace sigs {

// Threads and exceptions as values. No exception may leave a thread, so each thread's body is one call of guarded().
// BoundedQueue takes items from one thread to another.

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
// grants no more threads, or no memory for one; then nothing was started. Throws nothing, so that threads which the
// caller has started before are still joined.
template <class Body>
[[nodiscard]] Result<std::thread> started_thread(Body body);

// The same for a body that may throw: on_error is called, on the thread, with what it throws (see thrown_error()). It
// must not throw: there may be no memory for a copy of the error, which it may move away.
template <class Body, class OnError>
[[nodiscard]] Result<std::thread> started_thread(Body body, OnError on_error);

// Runs the body on a thread that nobody joins, or here where the system grants no more threads. The body must not
// throw.
void run_in_background(const std::function<void()>& body);

// Calls work(i) once for each i with 0 <= i < count, on up to `threads` threads, this one included, and returns when
// all calls have returned. Uses fewer threads where the system grants no more. When a call throws, no further call
// begins, and the first exception is thrown again here once the calls that had begun have returned.
template <class Work>
void parallel_for(int count, int threads, const Work& work);

// --- Memory.

// Makes the process's allocator keep memory of up to 32 MiB a block instead of returning it to the system. Images and
// layers of some megabytes are allocated for every frame; memory that is kept costs no page faults when it is used
// again. All threads share two heaps: a heap for each thread, glibc's default, keeps that memory many times
// (docs/reliability.md). For programs, before they start threads; nothing happens with another allocator than glibc's.
void tune_allocator();

// Some code allocates where no exception may leave (a JSON value's destructor). Where it finds no memory the program
// ends at once; after this call it does so with the error line of other shortages and exit status 69 in place of an
// abort. What it was writing stays in its staging folders, which the next run removes. For programs.
void end_plainly_without_memory();

// Whether so many bytes of addresses can still be mapped. Some libraries end the program where they do not get the
// memory that they begin with; this is asked before they are loaded.
[[nodiscard]] bool has_free_memory(std::size_t bytes);

// --- Templates.

// Why a thread could not be started; call it in a catch clause only.
[[nodiscard]] Error thread_not_started();

template <class Body>
Result<std::thread> started_thread(Body body) {
  try {
    return std::thread(std::move(body));
  } catch (...) {
    return fail(thread_not_started());
  }
}

template <class Body, class OnError>
Result<std::thread> started_thread(Body body, OnError on_error) {
  return started_thread([body = std::move(body), on_error = std::move(on_error)]() mutable {
    Result<void> done = guarded([&]() -> Result<void> {
      body();
      return {};
    });
    if (!done) on_error(std::move(done.error()));
  });
}

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
    Result<std::thread> other = started_thread(std::ref(run));
    if (!other) break;
    others.push_back(std::move(*other));
  }
  run();
  for (std::thread& other : others) other.join();
  if (thrown) std::rethrow_exception(thrown);
}

// A first-in, first-out queue of at most `capacity` items between any number of threads.
template <class T>
class BoundedQueue {
 public:
  // capacity: at least 1.
  explicit BoundedQueue(std::size_t capacity) : capacity_(capacity) {}

  // Appends an item; waits while the queue is full. False, and the item is dropped, where the queue is closed.
  bool put(T item) {
    std::unique_lock lock(mutex_);
    not_full_.wait(lock, [this] { return items_.size() < capacity_ || closed_; });
    if (closed_) return false;
    items_.push_back(std::move(item));
    not_empty_.notify_one();
    return true;
  }

  // Removes the first item; waits while the queue is empty. After close() returns the items that are left, then none.
  std::optional<T> take() {
    std::unique_lock lock(mutex_);
    not_empty_.wait(lock, [this] { return !items_.empty() || closed_; });
    if (items_.empty()) return std::nullopt;
    T item = std::move(items_.front());
    items_.pop_front();
    not_full_.notify_one();
    return item;
  }

  // Closes the queue: wakes all threads that wait, and lets put() fail from here on.
  void close() {
    const std::lock_guard lock(mutex_);
    closed_ = true;
    not_empty_.notify_all();
    not_full_.notify_all();
  }

 private:
  std::size_t capacity_;
  std::mutex mutex_;
  std::condition_variable not_full_;
  std::condition_variable not_empty_;
  std::deque<T> items_;
  bool closed_ = false;
};

// What another thread sets to end long work soon; null: nobody can.
using CancelFlag = const std::atomic<bool>*;

[[nodiscard]] inline bool is_cancelled(CancelFlag cancel) {
  return cancel != nullptr && cancel->load();
}

// The error `interrupted` once the flag is set.
//   where  what is being worked on; may be empty
[[nodiscard]] inline Result<void> check_interrupt(CancelFlag cancel, std::string where = "") {
  if (is_cancelled(cancel)) return fail(std::move(where), "interrupted; nothing was written", ErrorKind::interrupted);
  return {};
}

}  // namespace sigs
