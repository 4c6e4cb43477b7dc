// SPDX-License-Identifier: MIT
#include "editor/preview/ego_motion_job.h"

#include <algorithm>
#include <memory>

#include "base/pose.h"
#include "base/staged_outputs.h"
#include "ego_motion/ego_motion.h"
#include "scene/scene_files.h"
#include "scene/scene_parts.h"
#include "telemetry/track_csv.h"
#include "scene/opened_project.h"

namespace sigs::editor {

namespace {

Error error_of(const Problem& problem) {
  return {problem.field, problem.what, problem.kind};
}

cv::Mat bytes_of_share(const cv::Mat& share) {
  cv::Mat mask;
  if (!share.empty()) share.convertTo(mask, CV_8U, 255);
  return mask;
}

// The project's log, if it has rates to be used with the images. A log that cannot be read is a warning.
std::shared_ptr<const Track> track_with_rates(const Project& project, SceneFiles& files, const JobControl& control) {
  if (project.camera.track.file.empty()) return nullptr;
  const Result<std::shared_ptr<const Track>> track = files.track(resolved(project, project.camera.track.file));
  if (!track) {
    control.warn({track.error().where, track.error().what});
    return nullptr;
  }
  return (*track)->camera_rate_radps.empty() ? nullptr : *track;
}

}  // namespace

Result<EstimatedMotion> estimated_motion(const EgoMotionRequest& request, const JobControl& control) {
  const Project& project = request.project;
  Result<FrameSource> footage = open_footage(project, control.cancel);
  if (!footage) return fail(footage.error());
  const cv::Size size_px = footage->info().size_px;
  SceneFiles files;
  const OrProblem<Camera> camera = scene_camera(project, size_px, files);
  if (!camera) return fail(error_of(camera.error()));
  const OrProblem<cv::Mat> own_body = scene_own_body(project, size_px, files);
  if (!own_body) return fail(error_of(own_body.error()));
  const std::shared_ptr<const Track> log = track_with_rates(project, files, control);
  const EgoMotionSettings settings{.readout_s = project.camera.readout_s};
  const Result<EgoMotion> motion =
      estimate_ego_motion(*footage, *camera, bytes_of_share(*own_body), log.get(), settings,
                          {.progress = control.progress, .cancel = control.cancel});
  if (!motion) return fail(motion.error());
  Track track = track_of(*motion, resolved(project, project.footage.video));
  if (log) add_log(track, *log, *motion);
  if (project.camera.readout_s) track.readout_s = project.camera.readout_s;
  if (const Result<void> written = write_text(request.file, track_csv_text(track), false); !written)
    return fail(written.error());
  const auto lost =
      std::count_if(motion->frames.begin(), motion->frames.end(), [](const EgoFrame& f) { return f.is_lost; });
  return EstimatedMotion{.file = request.file,
                         .frames = static_cast<int>(motion->frames.size()),
                         .lost_frames = static_cast<int>(lost),
                         .level_sd_rad = motion->level_sd_rad,
                         .is_level_stated = project.camera.roll_deg || project.camera.pitch_deg,
                         .is_gyro_used = motion->gyro && motion->gyro->is_fused,
                         .warnings = motion->warnings};
}

}  // namespace sigs::editor
