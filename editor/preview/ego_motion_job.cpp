// SPDX-License-Identifier: MIT
#include "editor/preview/ego_motion_job.h"

#include <algorithm>

#include "base/staged_outputs.h"
#include "scene/opened_project.h"
#include "telemetry/track_csv.h"

namespace sigs::editor {

Result<EstimatedMotion> estimated_motion(const EgoMotionRequest& request, const JobControl& control) {
  const Project& project = request.project;
  Result<ProjectMotion> found =
      estimated_project_motion(project, {.progress = control.progress, .cancel = control.cancel});
  if (!found) return fail(found.error());
  for (const Warning& warning : found->warnings) control.warn(warning);
  if (const Result<void> written = write_text(request.file, track_csv_text(found->track), false); !written)
    return fail(written.error());
  const EgoMotion& motion = found->motion;
  const auto lost =
      std::count_if(motion.frames.begin(), motion.frames.end(), [](const EgoFrame& f) { return f.is_lost; });
  return EstimatedMotion{.file = request.file,
                         .frames = static_cast<int>(motion.frames.size()),
                         .lost_frames = static_cast<int>(lost),
                         .level_sd_rad = motion.level_sd_rad,
                         .is_level_stated = project.camera.roll_deg || project.camera.pitch_deg,
                         .is_gyro_used = motion.gyro && motion.gyro->is_fused,
                         .found = found->found,
                         .warnings = motion.warnings};
}

HorizonWatch::HorizonWatch(std::function<void()> wake) : job_(std::move(wake), found) {}

Result<SeenHorizons> HorizonWatch::found(const Request& request, const JobControl& control) {
  Result<FrameSource> footage = open_footage(*request.scene->project, control.cancel);
  if (!footage) return fail(footage.error());
  return seen_horizons(*footage, request.scene->draft.scene, control.cancel);
}

void HorizonWatch::follow(const std::shared_ptr<const OpenedScene>& shown) {
  const bool can_be_looked_at = shown && shown->footage && shown->footage->video && shown->draft.problems.empty();
  if (!can_be_looked_at) {
    seen_.reset();
    return;
  }
  const FootageSettings& wanted = shown->project->footage;
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
  (void)job_.start({shown});
}

}  // namespace sigs::editor
