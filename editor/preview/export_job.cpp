// SPDX-License-Identifier: MIT
#include "editor/preview/export_job.h"

#include <chrono>
#include <utility>

#include "base/threads.h"
#include "editor/preview/thread_priority.h"

namespace sigs::editor {

namespace {

double now_s() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

}  // namespace

ExportJob::ExportJob(std::function<void()> wake) : wake_(std::move(wake)) {}

ExportJob::~ExportJob() {
  cancel_ = true;
  if (thread_.joinable()) thread_.join();
}

bool ExportJob::start(ExportRequest request) {
  if (is_running()) return false;
  if (thread_.joinable()) thread_.join();
  cancel_ = false;
  rate_ = {};
  state_ = {.phase = ExportPhase::running, .request = std::move(request)};
  Result<std::thread> thread = started_thread([this] { run(); });
  if (thread)
    thread_ = std::move(*thread);
  else
    finish(fail(thread.error()));
  return true;
}

void ExportJob::run() {
  lower_thread_priority(kBackgroundNiceness);
  finish(guarded([this] { return exported(); }));
  wake_();
}

Result<ExportReport> ExportJob::exported() {
  const ExportControl control{.progress =
                                  [this](int done, int total) {
                                    {
                                      const std::lock_guard lock(mutex_);
                                      state_.done = done;
                                      state_.total = total;
                                      rate_.note(now_s(), done);
                                    }
                                    wake_();
                                  },
                              .warn =
                                  [this](const Warning& warning) {
                                    const std::lock_guard lock(mutex_);
                                    state_.warnings.push_back(warning);
                                  },
                              .cancel = &cancel_};
  return export_project(state_.request, control);
}

void ExportJob::finish(Result<ExportReport> report) {
  const std::lock_guard lock(mutex_);
  if (report) {
    state_.phase = ExportPhase::done;
    state_.report = std::move(*report);
    return;
  }
  const bool interrupted = report.error().kind == ErrorKind::interrupted;
  state_.phase = interrupted ? ExportPhase::cancelled : ExportPhase::failed;
  state_.error = std::move(report.error());
}

void ExportJob::cancel() {
  const std::lock_guard lock(mutex_);
  if (state_.phase != ExportPhase::running) return;
  cancel_ = true;
  state_.is_stopping = true;
}

bool ExportJob::is_running() const {
  const std::lock_guard lock(mutex_);
  return state_.is_running();
}

ExportState ExportJob::state() const {
  const std::lock_guard lock(mutex_);
  ExportState state = state_;
  state.rate_hz = rate_.rate_hz();
  state.left_s = rate_.left_s(state.total);
  return state;
}

void ExportJob::dismiss() {
  const std::lock_guard lock(mutex_);
  if (!state_.is_running()) state_ = {};
}

}  // namespace sigs::editor
