// SPDX-License-Identifier: MIT
#include "editor/preview/background_job.h"

#include <algorithm>
#include <chrono>

#include "export/export_project.h"
#include "scene/opened_project.h"

namespace sigs::editor {

namespace {

constexpr double kWindow_s = 8;
constexpr double kMinStep_s = 0.1;  // between notes that are kept: their number stays small
constexpr double kMinSpan_s = 0.2;  // a rate over less is noise

// The export of a rig as one.
Result<ExportReport> exported_cameras(const ExportRequest& request, const ExportControl& control) {
  const double begun_s = steady_now_s();
  Result<RigReport> rig = export_rig(request, control);
  if (!rig) return fail(rig.error());
  ExportReport all{.written = std::move(rig->written)};
  for (const ExportReport& camera : rig->cameras) {
    all.frames += camera.frames;
    all.damaged_frames += camera.damaged_frames;
    all.copied_frames += camera.copied_frames;
    all.warnings.insert(all.warnings.end(), camera.warnings.begin(), camera.warnings.end());
  }
  all.times.wall_s = steady_now_s() - begun_s;
  return all;
}

}  // namespace

void RateMeter::note(double now_s, int done) {
  const bool is_close = notes_.size() > 1 && now_s - notes_[notes_.size() - 2].time_s < kMinStep_s;
  if (is_close) notes_.pop_back();
  notes_.push_back({now_s, done});
  while (notes_.size() > 2 && now_s - notes_[1].time_s >= kWindow_s) notes_.pop_front();
}

std::optional<double> RateMeter::rate_hz() const {
  if (notes_.size() < 2) return std::nullopt;
  const double span_s = notes_.back().time_s - notes_.front().time_s;
  const int done = notes_.back().done - notes_.front().done;
  if (span_s < kMinSpan_s || done <= 0) return std::nullopt;
  return done / span_s;
}

std::optional<double> RateMeter::left_s(int total) const {
  const std::optional<double> rate = rate_hz();
  if (!rate) return std::nullopt;
  return std::max(0, total - notes_.back().done) / *rate;
}

double steady_now_s() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

Result<ExportReport> exported(const ExportRequest& request, const JobControl& control) {
  const ExportControl passed{.progress = control.progress, .warn = control.warn, .cancel = control.cancel};
  return request.project.cameras.empty() ? export_project(request, passed) : exported_cameras(request, passed);
}

Result<OwnBody> detected(const Project& project, const JobControl& control) {
  Result<FrameSource> source = open_footage(project, control.cancel);
  if (!source) return fail(source.error());
  return detect_own_body(*source, project.footage.first_frame, project.own_body,
                         {.progress = control.progress, .cancel = control.cancel, .stages = KeepStages::yes});
}

}  // namespace sigs::editor
