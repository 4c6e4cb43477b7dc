// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <deque>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>
#include <vector>

#include "base/threads.h"
#include "editor/preview/worker_thread.h"
#include "export/export_project.h"
#include "occlusion/detect.h"

namespace sigs::editor {

// Rate of a long piece of work over the last eight seconds: it neither jumps nor is slow to follow a change.
class RateMeter {
 public:
  // done  pieces that are done altogether; times and numbers only grow
  void note(double now_s, int done);

  // Pieces a second; none before there are notes over 0.2 s.
  [[nodiscard]] std::optional<double> rate_hz() const;

  // Seconds from the last note until `total` pieces are done, at this rate.
  [[nodiscard]] std::optional<double> left_s(int total) const;

 private:
  struct Note {
    double time_s = 0;
    int done = 0;
  };
  std::deque<Note> notes_;
};

// Seconds of a steady clock.
[[nodiscard]] double steady_now_s();

enum class JobPhase { none, running, done, cancelled, failed };

// A job at one moment.
template <class Request, class Value>
struct JobState {
  JobPhase phase = JobPhase::none;
  bool is_stopping = false;  // running, and asked to stop
  int done = 0;              // frames
  int total = 0;             // 0: not known yet
  std::optional<double> rate_hz;
  std::optional<double> left_s;
  std::vector<Warning> warnings;
  Error error;                         // of phase failed
  Request request;                     // the last one
  std::shared_ptr<const Value> value;  // of the last run that came to its end; null: none has
  Request value_request;               // what that run was asked for

  [[nodiscard]] bool is_running() const { return phase == JobPhase::running; }
};

// What a job's work reports while it runs, and how it learns that it is to stop.
struct JobControl {
  std::function<void(int done, int total)> progress;
  std::function<void(const Warning&)> warn;
  const std::atomic<bool>* cancel = nullptr;  // true: end soon, with an error of kind interrupted
};

// Runs a long piece of work in the background, one at a time, at low priority: the window and its images come first.
// All calls come from one thread, the window's.
template <class Request, class Value>
class BackgroundJob {
 public:
  using State = JobState<Request, Value>;
  using Work = std::function<Result<Value>(const Request&, const JobControl&)>;

  // work  called on the job's own thread; what it throws is an error like any other
  // wake  called from that thread as the work goes on, at most ten times a second, and at the end
  BackgroundJob(std::function<void()> wake, Work work) : wake_(std::move(wake)), work_(std::move(work)) {}
  // Stops the work and waits for it.
  ~BackgroundJob() {
    cancel_ = true;
    if (thread_.joinable()) thread_.join();
  }
  BackgroundJob(const BackgroundJob&) = delete;
  BackgroundJob& operator=(const BackgroundJob&) = delete;

  // False, and nothing happens, while one is running. Where the system gives no thread the job has failed at once. The
  // value of the run before stays until this one ends well.
  bool start(Request request) {
    if (is_running()) return false;
    if (thread_.joinable()) thread_.join();
    cancel_ = false;
    forget_ = false;
    rate_ = {};
    last_wake_s_ = 0;
    state_ = {.phase = JobPhase::running,
              .request = request,
              .value = std::move(state_.value),
              .value_request = std::move(state_.value_request)};
    Result<std::thread> thread = started_thread([this, request = std::move(request)] { run(request); });
    if (thread)
      thread_ = std::move(*thread);
    else
      finish(fail(thread.error()));
    return true;
  }

  // Asks the work to stop; the phase is cancelled as soon as it has.
  void cancel() {
    const std::lock_guard lock(mutex_);
    if (!state_.is_running()) return;
    cancel_ = true;
    state_.is_stopping = true;
  }

  // Drops the value and the outcome of the last run, and stops the one that is running: the phase is none, as soon as
  // the work has ended.
  void forget() {
    const std::lock_guard lock(mutex_);
    if (!state_.is_running()) {
      state_ = {};
      return;
    }
    cancel_ = true;
    forget_ = true;
    state_.is_stopping = true;
    state_.value = nullptr;
  }

  [[nodiscard]] bool is_running() const {
    const std::lock_guard lock(mutex_);
    return state_.is_running();
  }

  [[nodiscard]] State state() const {
    const std::lock_guard lock(mutex_);
    State state = state_;
    state.rate_hz = rate_.rate_hz();
    state.left_s = rate_.left_s(state.total);
    return state;
  }

 private:
  static constexpr double kWakeInterval_s = 0.1;

  void run(const Request& request) {
    lower_thread_priority(kBackgroundNiceness);
    finish(guarded([&] {
      return work_(request, {.progress = [this](int done, int total) { note(done, total); },
                             .warn =
                                 [this](const Warning& warning) {
                                   const std::lock_guard lock(mutex_);
                                   state_.warnings.push_back(warning);
                                 },
                             .cancel = &cancel_});
    }));
    wake_();
  }

  void note(int done, int total) {
    {
      const std::lock_guard lock(mutex_);
      state_.done = done;
      state_.total = total;
      const double now = steady_now_s();
      rate_.note(now, done);
      if (now - last_wake_s_ < kWakeInterval_s) return;
      last_wake_s_ = now;
    }
    wake_();
  }

  void finish(Result<Value> result) {
    const std::lock_guard lock(mutex_);
    if (forget_) {
      state_ = {};
      return;
    }
    state_.is_stopping = false;
    if (result) {
      state_.phase = JobPhase::done;
      state_.value = std::make_shared<const Value>(std::move(*result));
      state_.value_request = state_.request;
      return;
    }
    const bool interrupted = result.error().kind == ErrorKind::interrupted;
    state_.phase = interrupted ? JobPhase::cancelled : JobPhase::failed;
    state_.error = std::move(result.error());
  }

  std::function<void()> wake_;
  Work work_;
  mutable std::mutex mutex_;
  State state_;
  RateMeter rate_;
  double last_wake_s_ = 0;
  bool forget_ = false;
  std::atomic<bool> cancel_{false};
  std::thread thread_;
};

// Exports a project as `sigs export` does. A run that is stopped leaves no files behind.
using ExportState = JobState<ExportRequest, ExportReport>;
class ExportJob : public BackgroundJob<ExportRequest, ExportReport> {
 public:
  explicit ExportJob(std::function<void()> wake);
};

// What is looked through for the own body, and how.
struct DetectionRequest {
  std::filesystem::path video;
  int first_frame = 0;
  OwnBodySettings settings;

  [[nodiscard]] bool operator==(const DetectionRequest&) const = default;
};

// Opens the video and runs the engine's detection in it, as control asks.
[[nodiscard]] Result<OwnBody> detected(const DetectionRequest& request, const DetectionControl& control);

// Finds the own body in footage; images of all stages are kept with it.
using DetectionState = JobState<DetectionRequest, OwnBody>;
class OwnBodyJob : public BackgroundJob<DetectionRequest, OwnBody> {
 public:
  using Detect = std::function<Result<OwnBody>(const DetectionRequest&, const DetectionControl&)>;

  explicit OwnBodyJob(std::function<void()> wake, Detect detect = detected);
};

}  // namespace sigs::editor
