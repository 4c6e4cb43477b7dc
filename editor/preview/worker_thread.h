// SPDX-License-Identifier: MIT
#pragma once

#include <sys/resource.h>
#include <unistd.h>

#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

#include "base/result.h"
#include "base/threads.h"

namespace sigs::editor {

// Niceness of the editor's threads (man 2 setpriority): the window's own thread has 0 and comes first.
inline constexpr int kPreviewNiceness = 5;
inline constexpr int kBackgroundNiceness = 10;

// Gives the calling thread this niceness. Linux keeps it by thread, and threads inherit it from the one that starts
// them: those of the codecs and of the OpenGL driver follow. Where the system refuses, the thread keeps its priority.
inline void lower_thread_priority(int niceness) {
  (void)::setpriority(PRIO_PROCESS, static_cast<id_t>(::gettid()), niceness);
}

// One thread that works on the latest request. A request replaces the one before, whether that was worked on or not, so
// a slow work never falls behind. All calls but stop() and the destructor may come from any thread, also from work
// itself. Request: copyable, default-constructible (the value before the first want()), with operator==.
template <class Request>
class LatestRequestWorker {
 public:
  struct Setup {
    // Called on the thread once for each request that it finds, and again after wake() or repeat_after. What it throws
    // ends this call alone.
    std::function<void(const Request&)> work;
    int niceness = kPreviewNiceness;  // of the thread, from its start on
    // After how long work is called again with the same request; none, or an empty function: not by itself. Called with
    // the worker's lock held, so it must not call the worker.
    std::function<std::optional<std::chrono::milliseconds>(const Request&)> repeat_after;
  };

  // Starts the thread; work is first called after want() or wake(), or after repeat_after. Throws std::system_error
  // where the system gives no thread.
  explicit LatestRequestWorker(Setup setup) : setup_(std::move(setup)), thread_([this] { run(); }) {}
  ~LatestRequestWorker() { stop(); }
  LatestRequestWorker(const LatestRequestWorker&) = delete;
  LatestRequestWorker& operator=(const LatestRequestWorker&) = delete;

  // Ends the thread and waits for the call of work that is under way, which can notice it by latest(). Not from work
  // itself. Afterwards the other calls have no effect.
  void stop() {
    {
      const std::lock_guard lock(mutex_);
      stop_ = true;
    }
    changed_.notify_all();
    if (thread_.joinable()) thread_.join();
  }

  // Returns at once. A request equal to the latest changes nothing.
  void want(Request request) {
    const std::lock_guard lock(mutex_);
    if (request == latest_) return;
    latest_ = std::move(request);
    is_due_ = true;
    changed_.notify_all();
  }

  // Has work called again, though the request is the same.
  void wake() {
    const std::lock_guard lock(mutex_);
    is_due_ = true;
    changed_.notify_all();
  }

  // A copy of what is wanted by now; work compares it with its own to see whether it is still wanted. None: the worker
  // is about to end.
  [[nodiscard]] std::optional<Request> latest() const {
    const std::lock_guard lock(mutex_);
    return stop_ ? std::nullopt : std::optional(latest_);
  }

  // For work: waits for `time` and returns true, or returns false as soon as another request comes or the worker ends.
  [[nodiscard]] bool stays_latest(const Request& request, std::chrono::milliseconds time) {
    std::unique_lock lock(mutex_);
    return !changed_.wait_for(lock, time, [&] { return stop_ || latest_ != request; });
  }

 private:
  // Waits for the next request to work on. None: stop.
  std::optional<Request> next() {
    std::unique_lock lock(mutex_);
    const auto is_due = [this] { return stop_ || is_due_; };
    const auto pause = setup_.repeat_after ? setup_.repeat_after(latest_) : std::nullopt;
    if (pause)
      changed_.wait_for(lock, *pause, is_due);
    else
      changed_.wait(lock, is_due);
    is_due_ = false;
    return stop_ ? std::nullopt : std::optional(latest_);
  }

  void run() {
    lower_thread_priority(setup_.niceness);
    while (const std::optional<Request> request = next())
      static_cast<void>(guarded([&]() -> Result<void> {
        setup_.work(*request);
        return {};
      }));
  }

  Setup setup_;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  bool stop_ = false;
  bool is_due_ = false;  // work is to be called though it may have seen this request
  Request latest_{};
  std::thread thread_;  // last: it uses all of the above
};

}  // namespace sigs::editor
