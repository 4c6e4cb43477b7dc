// SPDX-License-Identifier: MIT
#include "editor/preview/own_body_job.h"

#include <chrono>
#include <utility>

#include "base/threads.h"
#include "editor/preview/thread_priority.h"

namespace sigs::editor {

namespace {

constexpr double kWakeInterval_s = 0.1;  // between two words to the window

double now_s() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

}  // namespace

Result<OwnBody> detected(const DetectionRequest& request, const DetectionControl& control) {
  Result<FrameSource> source = FrameSource::open(request.video, control.cancel);
  if (!source) return fail(source.error());
  return detect_own_body(*source, request.first_frame, request.settings, control);
}

OwnBodyJob::OwnBodyJob(std::function<void()> wake, Detect detect)
    : wake_(std::move(wake)), detect_(std::move(detect)) {}

OwnBodyJob::~OwnBodyJob() {
  cancel_ = true;
  if (thread_.joinable()) thread_.join();
}

bool OwnBodyJob::start(DetectionRequest request) {
  if (is_running()) return false;
  if (thread_.joinable()) thread_.join();
  cancel_ = false;
  forget_ = false;
  rate_ = {};
  last_wake_s_ = 0;
  state_ = {.phase = DetectionPhase::running,
            .request = request,
            .found = std::move(state_.found),
            .found_by = std::move(state_.found_by)};
  Result<std::thread> thread = started_thread([this, request = std::move(request)] { run(request); });
  if (thread)
    thread_ = std::move(*thread);
  else
    finish(fail(thread.error()));
  return true;
}

void OwnBodyJob::run(const DetectionRequest& request) {
  lower_thread_priority(kBackgroundNiceness);
  finish(guarded([&] {
    return detect_(request, {.progress = [this](int done, int total) { note(done, total); },
                             .cancel = &cancel_,
                             .stages = KeepStages::yes});
  }));
  wake_();
}

void OwnBodyJob::note(int done, int total) {
  {
    const std::lock_guard lock(mutex_);
    state_.done = done;
    state_.total = total;
    const double now = now_s();
    rate_.note(now, done);
    if (now - last_wake_s_ < kWakeInterval_s) return;
    last_wake_s_ = now;
  }
  wake_();
}

void OwnBodyJob::finish(Result<OwnBody> result) {
  const std::lock_guard lock(mutex_);
  if (forget_) {
    state_ = {};
    return;
  }
  state_.is_stopping = false;
  if (result) {
    state_.phase = DetectionPhase::done;
    state_.found = std::make_shared<const OwnBody>(std::move(*result));
    state_.found_by = state_.request;
    return;
  }
  const bool interrupted = result.error().kind == ErrorKind::interrupted;
  state_.phase = interrupted ? DetectionPhase::cancelled : DetectionPhase::failed;
  state_.error = result.error();
}

void OwnBodyJob::cancel() {
  const std::lock_guard lock(mutex_);
  if (!state_.is_running()) return;
  cancel_ = true;
  state_.is_stopping = true;
}

void OwnBodyJob::forget() {
  const std::lock_guard lock(mutex_);
  if (!state_.is_running()) {
    state_ = {};
    return;
  }
  cancel_ = true;
  forget_ = true;
  state_.is_stopping = true;
  state_.found = nullptr;
}

bool OwnBodyJob::is_running() const {
  const std::lock_guard lock(mutex_);
  return state_.is_running();
}

DetectionState OwnBodyJob::state() const {
  const std::lock_guard lock(mutex_);
  DetectionState state = state_;
  if (state.is_running()) state.left_s = rate_.left_s(state.total);
  return state;
}

}  // namespace sigs::editor
