// SPDX-License-Identifier: MIT
#include "job_thread.h"

#include <pybind11/pybind11.h>

#include <chrono>

namespace sigs::python {

namespace py = pybind11;

JobThread::JobThread() {
  thread_ = value_or_raise(started_thread([this] { work(); }));
}

JobThread::~JobThread() {
  end();
}

void JobThread::finish(const std::function<void()>& job) {
  const std::lock_guard turn(turn_);
  {
    std::unique_lock lock(mutex_);
    job_ = &job;
    changed_.notify_all();
    changed_.wait(lock, [this] { return job_ == nullptr; });
  }
  end();
}

void JobThread::end() {
  if (!thread_.joinable()) return;
  {
    const std::lock_guard lock(mutex_);
    ending_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

void JobThread::work() {
  std::unique_lock lock(mutex_);
  while (true) {
    changed_.wait(lock, [this] { return job_ != nullptr || ending_; });
    if (job_ == nullptr) return;
    const std::function<void()>& job = *job_;
    lock.unlock();
    job();
    lock.lock();
    job_ = nullptr;
    changed_.notify_all();
  }
}

void JobThread::run(const std::function<void()>& job, const std::function<void()>& poll) {
  constexpr std::chrono::milliseconds kPoll{50};
  std::optional<py::error_already_set> raised;
  const auto look = [&] {  // with the GIL
    if (raised) return;
    try {
      if (PyErr_CheckSignals() != 0) throw py::error_already_set();
      if (poll) poll();
    } catch (py::error_already_set& error) {
      raised.emplace(error);
      cancel_ = true;
    }
  };
  {
    const py::gil_scoped_release released;
    const std::lock_guard turn(turn_);
    std::unique_lock lock(mutex_);
    job_ = &job;
    changed_.notify_all();
    while (!changed_.wait_for(lock, kPoll, [this] { return job_ == nullptr; })) {
      lock.unlock();
      {
        const py::gil_scoped_acquire acquired;
        look();
      }
      lock.lock();
    }
  }
  if (poll) look();
  if (raised) throw py::error_already_set(*raised);
}

}  // namespace sigs::python
