// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "base/pose.h"
#include "scene/scene.h"

namespace sigs {

struct PlacedIntruder {
  int id = 0;  // number in Scene::intruders
  Pose<frame::Camera, frame::Body> camera_from_body;
  Attitude attitude;  // in the world

  [[nodiscard]] double distance_m() const { return glm::length(camera_from_body.translation_m); }
};

// One moment of a scene.
struct SceneMoment {
  double time_s = 0;
  Pose<frame::World, frame::Camera> world_from_camera;
  glm::dvec3 light_in_camera{0, 0, 0};    // metres, camera frame
  std::vector<PlacedIntruder> intruders;  // far to near, equal distances by id
};

// Between two known turns at constant rate about one axis, the shorter way; before the first as the first, after the
// last as the last; none: level.
[[nodiscard]] glm::dquat world_from_carrier_at(const std::vector<CarrierAttitude>& turns, double time_s);

// The carrier's turn on top of the constant attitude: R = world_from_carrier * R at start.
[[nodiscard]] Pose<frame::World, frame::Camera> camera_at(const CameraMotion& motion, double time_s);

// frame counts the footage's frames from 0.
[[nodiscard]] SceneMoment scene_at(const Scene& scene, int frame);

}  // namespace sigs
