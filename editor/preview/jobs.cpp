// SPDX-License-Identifier: MIT
#include "editor/preview/jobs.h"

#include <algorithm>
#include <utility>

#include "appearance/appearance.h"
#include "base/staged_outputs.h"
#include "first_project/first_camera.h"
#include "scene/opened_project.h"
#include "telemetry/track_csv.h"
#include "video/frame_source.h"

namespace sigs::editor {

namespace {

// Of another project files of the same names may be others.
FootageSettings with_absolute_paths(const Project& project) {
  FootageSettings footage = project.footage;
  for (std::string* const path : {&footage.video, &footage.timestamps, &footage.calibration, &footage.own_body_mask})
    if (!path->empty()) *path = std::filesystem::absolute(resolved(project, *path)).lexically_normal().string();
  return footage;
}

Result<SeenHorizons> horizons_in(const std::shared_ptr<const OpenedScene>& scene, const JobControl& control) {
  Result<FrameSource> footage = open_footage(*scene->project, control.cancel);
  if (!footage) return fail(footage.error());
  return seen_horizons(*footage, scene->draft.scene, control.cancel);
}

// "a pinhole of 69.5 degrees along the diagonal, by what the file states (...)"; "" where it is of no use.
std::string stated_lens(const std::filesystem::path& video, const VideoInfo& info, const LoggedLens& lens) {
  if (!lens.diagonal_fov_rad && !lens.horizontal_fov_rad) return "";
  const Result<FirstCamera> camera = first_camera({.video = video}, info, lens);
  return camera ? camera->note.text.substr(0, camera->note.text.find(';')) : "";
}

}  // namespace

Result<Appearance> estimated_appearance(const Project& project, const JobControl& control) {
  return appearance_of_footage(project, {.first = project.footage.first_frame, .last = project.footage.last_frame},
                               is_still_guessed(project, "camera.position_m"),
                               {.progress = control.progress, .cancel = control.cancel, .warn = control.warn});
}

Result<LitLike> found_light(const LightRequest& request, const JobControl& control) {
  return lit_like(request.project, request.frame, request.box,
                  {.progress = control.progress, .cancel = control.cancel});
}

Result<EstimatedMotion> estimated_motion(const EgoMotionRequest& request, const JobControl& control) {
  const Project& project = request.project;
  Result<ProjectMotion> found =
      estimated_project_motion(project, {.progress = control.progress, .cancel = control.cancel});
  if (!found) return fail(found.error());
  for (const Warning& warning : found->warnings) control.warn(warning);
  if (const Result<void> written = write_text(request.file, track_csv_text(found->track), false); !written)
    return fail(written.error());
  const EgoMotion& motion = found->motion;
  const auto lost = std::ranges::count_if(motion.frames, &EgoFrame::is_lost);
  return EstimatedMotion{.file = request.file,
                         .frames = static_cast<int>(motion.frames.size()),
                         .lost_frames = static_cast<int>(lost),
                         .level_sd_rad = motion.level_sd_rad,
                         .is_level_stated = project.camera.roll_deg || project.camera.pitch_deg,
                         .is_gyro_used = motion.gyro && motion.gyro->is_fused,
                         .found = found->found,
                         .warnings = motion.warnings};
}

HorizonWatch::HorizonWatch(std::function<void()> wake) : job_(std::move(wake), horizons_in) {}

void HorizonWatch::follow(const std::shared_ptr<const OpenedScene>& shown) {
  const bool can_be_looked_at = shown && shown->footage && shown->footage->video && shown->draft.problems.empty();
  if (!can_be_looked_at) return seen_.reset();
  const FootageSettings wanted = with_absolute_paths(*shown->project);
  if (asked_ != wanted || !shown->draft.scene.horizon_is_known) seen_.reset();
  if (!shown->draft.scene.horizon_is_known) return;
  if (job_.is_running()) {
    if (asked_ != wanted) job_.cancel();
    return;
  }
  if (asked_ == wanted) {
    if (seen_ == nullptr) seen_ = job_.state().value;
    return;
  }
  job_.forget();
  asked_ = wanted;
  (void)job_.start(shown);
}

FirstProjectJob::FirstProjectJob(std::function<void()> wake, const Make& make)
    : BackgroundJob(std::move(wake), [make](const FirstProjectOptions& options, const JobControl& control) {
        const auto tell = [&](int done, int total, const std::string& text) {
          control.tell(text);
          control.progress(done, total);
        };
        return make(options, {.progress = tell, .cancel = control.cancel});
      }) {}

Result<VideoFacts> video_facts(const std::filesystem::path& video, const JobControl& control) {
  const Result<FrameSource> footage = FrameSource::open(video, control.cancel);
  if (!footage) return fail(footage.error());
  const VideoInfo& info = footage->info();
  const double rate_hz = double(info.frame_rate_num) / std::max(1, info.frame_rate_den);
  const double last_s = info.times_s.empty() ? 0 : info.times_s.back();
  const Result<FirstLog> log = log_of_video(video, control.cancel);
  if (!log) return fail(log.error());
  return VideoFacts{.size_px = info.size_px,
                    .frames = info.frame_count(),
                    .duration_s = last_s + (rate_hz > 0 ? 1 / rate_hz : 0),
                    .rate_hz = rate_hz,
                    .lens = log->lens ? stated_lens(video, info, *log->lens) : ""};
}

}  // namespace sigs::editor
