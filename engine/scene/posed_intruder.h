// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "base/pose.h"
#include "base/result.h"
#include "scene/scene.h"
#include "scene/scene_files.h"

namespace sigs {

// Poses that do not come from the project but from outside, frame by frame: a closed loop, in which a controller or a
// simulator moves the intruders and the camera.

// The pose of a body at one frame, in the world. The velocity counts within the frame alone: for motion blur while the
// shutter is open, and for a rolling shutter. The attitude does not change within the frame.
struct GivenPose {
  glm::dvec3 position_m{0, 0, 0};
  Attitude attitude = {};
  glm::dvec3 velocity_mps{0, 0, 0};
};

// The pose of one intruder, by its index in Scene::intruders.
struct GivenIntruderPose {
  int intruder = 0;
  GivenPose pose;
};

// What is given at one frame; everything else follows the project.
struct GivenPoses {
  std::optional<GivenPose> camera;  // of the camera itself, its mounting included
  std::vector<GivenIntruderPose> intruders;

  [[nodiscard]] bool empty() const { return !camera && intruders.empty(); }
};

// The scene with these poses at a frame; all else of it is the same, and what is large is shared. It is meant for that
// frame alone. Errors, kind usage: a number that is not finite or a place farther than 1e8 m from the world's origin, a
// speed of more than 1e6 m/s, an index that is none; `where` names the body.
[[nodiscard]] Result<Scene> with_poses(Scene scene, int frame, const GivenPoses& poses);

// How an intruder is to be seen in one frame: where, how large, and how it moves in the image. This is the reverse of a
// project, whose waypoints say where it is; it serves to compare an intruder with what footage shows.
struct IntruderPose {
  cv::Point2d middle_px;      // middle of its silhouette's box
  double width_px = 0;        // of that box, above 0
  double aspect = 0;          // its width over its height; 0: any
  cv::Point2d step_px{0, 0};  // motion in the image from one frame to the next
  // Where it is against middle_px in successive frames, the middle one of them being the pose's; an odd number. Frames
  // before and after go on by step_px. Empty: step_px alone.
  std::vector<cv::Point2d> path_px = {};
  double speed_mps = 60;  // through the world, along the nose
  // Share by which it grows in the image per second, below 0 where it shrinks. The nose then points towards the camera
  // or away from it, and the speed, in place of speed_mps, is that with which flying on gives this, 1 m/s at least.
  // Needs lowest_rad below 1.2: what is seen steeply from below cannot come nearer by flying on.
  std::optional<double> growth_per_s = {};
  double lowest_rad = 0.1, highest_rad = 1.0;  // elevations above the horizon from which one is chosen
  std::uint32_t seed = 1;                      // chooses among the views whose aspect is near enough
};

// The scene of a project with its first intruder seen so in `frame`, wings level, above the camera; the others are left
// out. The camera stands at the project's position and turns with the intruder, as if somebody held it: track,
// attitude and speed of the project's camera, its own body and its range of frames are ignored. World X is the
// direction in which the intruder is seen. Errors are those of open_scene; usage where there is no intruder;
// bad_project where the pixel has no ray.
[[nodiscard]] Result<Scene> posed_scene(const Project& project, const FootageShape& footage, SceneFiles& files,
                                        int frame, const IntruderPose& pose);

}  // namespace sigs
