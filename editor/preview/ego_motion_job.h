// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <vector>

#include "editor/preview/background_job.h"
#include "project/project.h"

namespace sigs::editor {

// Whose camera motion is to be estimated, and the CSV file (telemetry/track_csv.h) that it is written to.
struct EgoMotionRequest {
  Project project;
  std::filesystem::path file;
};

// What was found, with the file written.
struct EstimatedMotion {
  std::filesystem::path file;
  int frames = 0;
  int lost_frames = 0;                 // of which the turn is not known
  std::optional<double> level_sd_rad;  // standard deviation of roll and pitch as a whole; none: no horizon was seen,
                                       // frame 0 is as the project's camera.attitude_deg says
  bool is_level_stated = false;        // without a horizon: the project had roll or pitch
  bool is_gyro_used = false;
  std::vector<Warning> warnings;
};

// Estimates the camera's rotation from the project's footage, calibration and own-body mask, and with the rates of
// camera.track.file where that has some (ego_motion/ego_motion.h), and writes it as the camera's whole attitude. On the
// calling thread, for minutes. Nothing is written where it fails or is cancelled. Errors: those of FrameSource::open(),
// of calibration and mask, of estimate_ego_motion(), and of writing a file that must not be there yet.
[[nodiscard]] Result<EstimatedMotion> estimated_motion(const EgoMotionRequest& request, const JobControl& control);

// The same in the background (editor/views/estimate_session.h).
using EgoMotionState = JobState<EgoMotionRequest, EstimatedMotion>;

}  // namespace sigs::editor
