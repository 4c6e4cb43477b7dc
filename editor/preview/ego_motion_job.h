// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <vector>

#include "editor/preview/background_job.h"
#include "editor/preview/preview_output.h"
#include "ego_motion/project_motion.h"
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
  FoundAttitudes found = {};  // what the project has to state of them, without the file's name
  std::vector<Warning> warnings;
};

// Estimates the camera's rotation (estimated_project_motion()) and writes it as the camera's whole attitude. On the
// calling thread, for minutes. Nothing is written where it fails or is cancelled. Errors: those of
// estimated_project_motion(), and of writing a file that must not be there yet.
[[nodiscard]] Result<EstimatedMotion> estimated_motion(const EgoMotionRequest& request, const JobControl& control);

// The same in the background (editor/views/estimate_session.h).
using EgoMotionState = JobState<EgoMotionRequest, EstimatedMotion>;

// Looks for the horizon in the footage of the scenes that are shown, in the background: once for each footage, lens and
// own body, where the attitude is stated and all could be opened. For the window's thread, all calls.
class HorizonWatch {
 public:
  explicit HorizonWatch(std::function<void()> wake);

  // Once per update.
  void follow(const std::shared_ptr<const OpenedScene>& shown);

  // What was found in the footage of the scene that was followed last; null: nothing yet.
  [[nodiscard]] const std::shared_ptr<const SeenHorizons>& seen() const { return seen_; }

 private:
  struct Request {
    std::shared_ptr<const OpenedScene> scene;
  };
  [[nodiscard]] static Result<SeenHorizons> found(const Request& request, const JobControl& control);

  BackgroundJob<Request, SeenHorizons> job_;
  FootageSettings asked_;  // for which it was begun
  std::shared_ptr<const SeenHorizons> seen_;
};

}  // namespace sigs::editor
