// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

#include "base/result.h"
#include "base/threads.h"
#include "errors.h"

namespace sigs::python {

// A thread that does one job after another while Python goes on: the caller waits without Python's lock (GIL), and
// looks for signals meanwhile, so that Ctrl-C works. OpenGL contexts and decoders live on one such thread.
class JobThread {
 public:
  // Raises the error unavailable where the system gives no more threads.
  JobThread();
  ~JobThread();  // ends the thread after its current job
  JobThread(const JobThread&) = delete;
  JobThread& operator=(const JobThread&) = delete;

  // Runs job(cancel) on the thread and returns its value, or raises its error. To be called with the GIL; several
  // callers take turns. On a signal whose handler raises, `cancel` is set, the job is waited for, and that exception is
  // raised.
  //   poll  called with the GIL some 20 times a second while the job runs, and once after it
  template <class Job>
  auto wait_for(const Job& job, const std::function<void()>& poll = {}) {
    std::optional<std::invoke_result_t<Job, const std::atomic<bool>*>> result;
    run([&] { result.emplace(guarded([&] { return job(&cancel_); })); }, poll);
    return value_or_raise(std::move(*result));
  }

  // Runs a last job, without looking for signals, and ends the thread. To be called without the GIL.
  void finish(const std::function<void()>& job);

  // Set once a job was interrupted; what it worked on may be incomplete.
  [[nodiscard]] bool was_cancelled() const { return cancel_; }

 private:
  void run(const std::function<void()>& job, const std::function<void()>& poll);
  void work();
  void end();

  std::mutex turn_;   // of the callers
  std::mutex mutex_;  // of what follows
  std::condition_variable changed_;
  const std::function<void()>* job_ = nullptr;  // null: none, or done
  bool ending_ = false;
  std::atomic<bool> cancel_{false};
  std::thread thread_;
};

}  // namespace sigs::python
