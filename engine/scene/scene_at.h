// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "base/pose.h"
#include "scene/scene.h"

namespace sigs {

// Where an intruder is at one moment.
struct PlacedIntruder {
  int id = 0;  // index in Scene::intruders
  Pose<frame::Camera, frame::Body> camera_from_body;
  Attitude attitude;  // in the world

  // From the camera to the intruder's reference point.
  [[nodiscard]] double distance_m() const { return glm::length(camera_from_body.translation_m); }
};

// Where everything is at one moment.
struct SceneMoment {
  double time_s = 0;
  Pose<frame::World, frame::Camera> world_from_camera;
  glm::dvec3 light_in_camera{0, 0, 0};    // position in metres, camera frame
  std::vector<PlacedIntruder> intruders;  // far to near; equal distances by id
};

// Attitude of the carrier: between two known ones by spherical linear interpolation (slerp), before the first and after
// the last as these; level where none is known.
[[nodiscard]] glm::dquat world_from_carrier_at(const std::vector<CarrierAttitude>& turns, double time_s);

// Pose of the camera. Its attitude is world_from_carrier_at(time_s) * attitude at the start.
[[nodiscard]] Pose<frame::World, frame::Camera> camera_at(const CameraMotion& motion, double time_s);

// The scene at a frame of the footage, counted from 0.
[[nodiscard]] SceneMoment scene_at(const Scene& scene, int frame);

}  // namespace sigs
