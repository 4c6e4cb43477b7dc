// SPDX-License-Identifier: MIT
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "base/pose.h"
#include "base/result.h"
#include "scene/scene.h"

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

}  // namespace sigs
