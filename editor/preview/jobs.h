// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <opencv2/core/types.hpp>
#include <optional>
#include <string>
#include <vector>

#include "appearance/appearance.h"
#include "comparison/lit_like.h"
#include "editor/preview/background_job.h"
#include "editor/preview/preview_output.h"
#include "ego_motion/project_motion.h"
#include "first_project/first_project.h"
#include "project/project.h"

namespace sigs::editor {

// Estimates how the footage looks (appearance/appearance.h) in the frames that the project uses. On the calling thread,
// for seconds. Errors: those of open_footage() and of estimate_appearance().
[[nodiscard]] Result<Appearance> estimated_appearance(const Project& project, const JobControl& control);

// The same in the background (editor/views/estimate_session.h).
using AppearanceState = JobState<Project, Appearance>;

// By what in the footage the light is to be found.
struct LightRequest {
  Project project;
  int frame = 0;
  Box box;
};

// The light on what is in the box (comparison/lit_like.h). On the calling thread, for seconds. Errors: those of
// lit_like().
[[nodiscard]] Result<LitLike> found_light(const LightRequest& request, const JobControl& control);

using LightState = JobState<LightRequest, LitLike>;

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

  void follow(const std::shared_ptr<const OpenedScene>& shown);  // once per update

  // What was found in the footage of the scene that was followed last; null: nothing yet.
  [[nodiscard]] const std::shared_ptr<const SeenHorizons>& seen() const { return seen_; }

 private:
  BackgroundJob<std::shared_ptr<const OpenedScene>, SeenHorizons> job_;
  FootageSettings asked_;  // for which it was begun, with absolute paths
  std::shared_ptr<const SeenHorizons> seen_;
};

// Makes a project of a video in the background, as `sigs init` does, and tells what it is at. Nothing is written where
// it fails or is cancelled.
using FirstProjectState = JobState<FirstProjectOptions, FirstProject>;
class FirstProjectJob : public BackgroundJob<FirstProjectOptions, FirstProject> {
 public:
  // What does the work; tests give one that reads no video.
  using Make = std::function<Result<FirstProject>(const FirstProjectOptions&, const FirstProjectControl&)>;

  explicit FirstProjectJob(std::function<void()> wake, const Make& make = make_first_project);
};

// What a video tells of itself.
struct VideoFacts {
  cv::Size size_px;
  int frames = 0;
  double duration_s = 0;
  double rate_hz = 0;
  std::string lens;  // how its file states the lens; "": it does not
};

// Reads the index of a video, and what its file or its flight log says of the lens. Errors: those of
// FrameSource::open(); interrupted.
[[nodiscard]] Result<VideoFacts> video_facts(const std::filesystem::path& video, const JobControl& control);

using VideoFactsState = JobState<std::filesystem::path, VideoFacts>;

}  // namespace sigs::editor
