// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "base/pose.h"
#include "ego_motion/ego_motion.h"
#include "project/project.h"
#include "project/validate.h"
#include "scene/scene.h"

namespace sigs {

// A project and the attitudes that its own footage shows: they are estimated from what it names, it is made to follow
// them, and those that it has are held against the horizon in sight.

// What a project has to state of attitudes that were found in its footage and are written to a file (track_of()).
struct FoundAttitudes {
  std::string file;                                 // as the project names it
  bool is_complete = true;                          // each frame has one
  std::optional<Attitude> level_at_start = {};      // roll and pitch at frame 0; none: no horizon was seen
  std::optional<Attitude> stated_at_start = {};     // the camera's at frame 0 as the project had it so far, where
                                                    // camera.attitude_deg alone does not say it
  std::optional<double> heading_of_world_rad = {};  // of world X so far, where a log said it
};

// Of an estimate for a project that nothing else turns, as one that is being made.
[[nodiscard]] FoundAttitudes found_attitudes(const EgoMotion& motion, const std::string& file);

// Makes the project follow the attitudes: the file becomes camera.track.file, as the camera's own attitude
// (camera.track.mount), with the positions that it has unless camera.track.position was `none`; camera.attitude_deg
// becomes the camera's attitude at frame 0, of which the yaw stays; camera.attitude_file is left out.
void follow_attitudes(Project& project, const FoundAttitudes& found);

// What estimated_project_motion() gives.
struct ProjectMotion {
  EgoMotion motion;
  Track track;                    // with what the project's log knows besides, to be written as `found.file`
  FoundAttitudes found;           // without the file's name
  std::vector<Warning> warnings;  // of the footage, the calibration and the log; those of the motion are its own
};

// estimate_ego_motion() from a project's footage, calibration and own-body mask and with the rates of its log, where
// that has some. A log that cannot be read is a warning. Positions of the log that the project used stay on the
// footage's time as the gyroscope places them, else as camera.track.offset_s does. Errors name project file and field,
// or are those of open_footage(), estimate_ego_motion() and check_known().
[[nodiscard]] Result<ProjectMotion> estimated_project_motion(const Project& project, const EgoMotionControl& control,
                                                             double max_unknown_share = kMaxUnknownShare);

// A horizon in one frame (horizon.h).
struct SeenHorizon {
  int frame = 0;
  glm::dvec3 up_in_camera{0, 0, -1};  // unit
  double sd_rad = 0;                  // of that, haze and hills included

  [[nodiscard]] bool operator==(const SeenHorizon&) const = default;
};

// What twelve frames, spread over the scene's range, show of the horizon. It depends on footage, lens, own body and
// range alone, whatever the camera's attitude.
struct SeenHorizons {
  std::vector<SeenHorizon> horizons;
  int frames = 0;  // that were looked at

  [[nodiscard]] bool operator==(const SeenHorizons&) const = default;
};

// Frames that cannot be read are left out; fewer are looked at once *cancel is true, which may be null.
//   footage  of the scene
[[nodiscard]] SeenHorizons seen_horizons(FrameSource& footage, const Scene& scene, const std::atomic<bool>* cancel);

// Where the camera's attitude contradicts the horizon in the images: a problem of camera.track.mount or
// camera.attitude_deg if at least half of the frames agree within 2 degrees on a level, turned into the world by the
// scene's attitude, that is off by more than 3 degrees and three of its standard deviations. None too where the
// attitude is not stated.
[[nodiscard]] std::optional<Problem> level_contradiction(const SeenHorizons& seen, const Project& project,
                                                         const Scene& scene);

}  // namespace sigs
