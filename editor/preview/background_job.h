// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "base/threads.h"
#include "editor/preview/worker_thread.h"
#include "export/export_project.h"
#include "occlusion/detect.h"
#include "project/project.h"

namespace sigs::editor {

// Rate of a long piece of work over the last eight seconds: it neither jumps nor is slow to follow a change. Not
// protected by a lock; its owner has to see to that.
class RateMeter {
 public:
  // Call it whenever some pieces have been finished. Notes closer than 0.1 s replace each other, so their number is
  // bounded.
  //   now_s  seconds of any steady clock
  //   done   pieces that are done altogether
  // Neither may become smaller from one call to the next.
  void note(double now_s, int done);

  // Pieces a second. None before the notes span 0.2 s, and while no piece was done in the last eight seconds.
  [[nodiscard]] std::optional<double> rate_hz() const;

  // Seconds from the last note until `total` pieces are done, at this rate; 0 where they are done already. None where
  // rate_hz() is none.
  [[nodiscard]] std::optional<double> left_s(int total) const;

 private:
  struct Note {
    double time_s = 0;  // of the caller's clock
    int done = 0;
  };
  std::deque<Note> notes_;
};

// Seconds of std::chrono::steady_clock. Its zero is arbitrary: only differences mean something.
[[nodiscard]] double steady_now_s();

// none: not started yet, or forgotten. The last three say how the last run ended.
enum class JobPhase { none, running, done, cancelled, failed };

// 0..1, for a bar; 0 while the total is not known.
[[nodiscard]] inline float share_done(int done, int total) {
  return total > 0 ? static_cast<float>(done) / static_cast<float>(total) : 0;
}

// A job at one moment, as a copy that the caller may keep. While it runs, the numbers are those of the last progress.
template <class Request, class Value>
struct JobState {
  JobPhase phase = JobPhase::none;
  bool is_stopping = false;  // the job is running and has been asked to stop; it ends as soon as its work notices
  // Frames that are done, of `total`. total == 0: not known yet.
  int done = 0;
  int total = 0;
  std::string step;  // what is being done, in words: "reading the video"; "": it was not told
  // Frames a second and seconds until the end, as RateMeter gives them; none where it gives none.
  std::optional<double> rate_hz;
  std::optional<double> left_s;
  std::vector<Warning> warnings;  // of this run, in the order in which they came
  // Why the last run did not end well. Set where phase is failed, and with the kind interrupted where it is cancelled.
  Error error;
  Request request;  // what the last run was asked for, whether it is still running or has ended in any way
  // Result of the last run that came to its end, and what that run was asked for. Both stay while another run is under
  // way and when it fails. Null: no run has come to its end, or forget() was called.
  std::shared_ptr<const Value> value;
  Request value_request;

  [[nodiscard]] bool is_running() const { return phase == JobPhase::running; }
};

// What a job's work reports while it runs, and how it learns that it is to stop. The functions may be called from any
// thread, as long as work has not returned.
struct JobControl {
  std::function<void(int done, int total)> progress;  // frames done so far and in all
  std::function<void(const std::string&)> tell = {};  // sets JobState::step, without waking the window
  std::function<void(const Warning&)> warn;           // adds to JobState::warnings, without waking the window
  // True: end soon, with an error of kind interrupted. A BackgroundJob always sets it; alive until work returns.
  const std::atomic<bool>* cancel = nullptr;
};

// Runs a long piece of work in the background, one at a time, at low priority (kBackgroundNiceness): the window and its
// images come first. All public calls come from one thread, the window's. None of them waits for the work, save for the
// destructor. Request: copyable and default-constructible. Value: movable.
template <class Request, class Value>
class BackgroundJob {
 public:
  using State = JobState<Request, Value>;
  // What is run. An error of kind interrupted means that it stopped because it was asked to.
  using Work = std::function<Result<Value>(const Request&, const JobControl&)>;

  // work  called on the job's own thread; what it throws is an error like any other
  // wake  called from that thread as the work goes on, at most ten times a second, and at the end
  BackgroundJob(std::function<void()> wake, Work work) : wake_(std::move(wake)), work_(std::move(work)) {}
  // Stops the work and waits until it has ended.
  ~BackgroundJob() {
    cancel_ = true;
    if (thread_.joinable()) thread_.join();
  }
  BackgroundJob(const BackgroundJob&) = delete;
  BackgroundJob& operator=(const BackgroundJob&) = delete;

  // Begins a run and returns true. Returns false, and does nothing, while one is running. Where the system gives no
  // thread, the job has failed at once. The value of the run before stays until this one ends well.
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
      finish(fail(std::move(thread.error())));
    return true;
  }

  // Asks the work to stop and returns at once; the phase is cancelled as soon as the work has stopped. A run that
  // reaches its end all the same is done. Nothing happens where none is running.
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
      rate_ = {};
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

  // A copy of the state, once per update of the window.
  [[nodiscard]] State state() const {
    const std::lock_guard lock(mutex_);
    State state = state_;
    state.rate_hz = rate_.rate_hz();
    state.left_s = rate_.left_s(state.total);
    return state;
  }

 private:
  static constexpr double kWakeInterval_s = 0.1;  // shortest time between two calls of wake() for progress alone

  // The thread's body. wake() is called a last time after the state says how it ended.
  void run(const Request& request) {
    lower_thread_priority(kBackgroundNiceness);
    finish(guarded([&] {
      return work_(request, {.progress = [this](int done, int total) { note(done, total); },
                             .tell =
                                 [this](const std::string& step) {
                                   const std::lock_guard lock(mutex_);
                                   state_.step = step;
                                 },
                             .warn =
                                 [this](const Warning& warning) {
                                   const std::lock_guard lock(mutex_);
                                   state_.warnings.push_back(warning);
                                 },
                             .cancel = &cancel_});
    }));
    wake_();
  }

  // JobControl::progress. wake() is called without the lock, so it may ask for the state.
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

  // Enters how the run ended, or drops it where forget() was called meanwhile.
  void finish(Result<Value> result) {
    const std::lock_guard lock(mutex_);
    if (forget_) {
      state_ = {};
      rate_ = {};
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
  // Guards state_, rate_, last_wake_s_ and forget_.
  mutable std::mutex mutex_;
  State state_;
  RateMeter rate_;
  double last_wake_s_ = 0;
  bool forget_ = false;              // the run that is under way was forgotten: its outcome is dropped
  std::atomic<bool> cancel_{false};  // JobControl::cancel of the run that is under way
  std::thread thread_;
};

// Exports a project as `sigs export` does, with all of its cameras where it has several. A run that is stopped leaves
// no files behind. The request holds the project by value, so edits made meanwhile do not matter.
[[nodiscard]] Result<ExportReport> exported(const ExportRequest& request, const JobControl& control);

using ExportJob = BackgroundJob<ExportRequest, ExportReport>;
using ExportState = ExportJob::State;

// Finds the own body in the footage of a project, from the first frame that the project uses on, by its settings, with
// images of all stages. Errors: those of open_footage() and of detect_own_body().
[[nodiscard]] Result<OwnBody> detected(const Project& project, const JobControl& control);

using OwnBodyJob = BackgroundJob<Project, OwnBody>;
using DetectionState = OwnBodyJob::State;

}  // namespace sigs::editor
