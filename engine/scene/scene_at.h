// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "base/pose.h"
#include "scene/scene.h"

namespace sigs {

// Where an intruder is at one moment.
struct PlacedIntruder {
  int id = 0;  // index in Scene::intruders
  Pose<frame::Camera, frame::Body> camera_from_body;
  glm::dquat world_from_body{1, 0, 0, 0};  // its attitude

  // From the camera to the intruder's reference point.
  [[nodiscard]] double distance_m() const { return glm::length(camera_from_body.translation_m); }
};

// Where everything is at one moment.
struct SceneMoment {
  double time_s = 0;
  double exposure_s = 0;  // how long the shutter is open, half of it before time_s
  Pose<frame::World, frame::Camera> world_from_camera;
  glm::dvec3 light_in_camera{0, 0, 0};    // position of the point light in metres, camera frame
  glm::dvec3 to_sun_in_camera{0, 0, -1};  // unit vector, camera frame
  double sun_visible_share = 1;           // 0..1: of the sun's disc that is above the horizon
  glm::dvec3 up_in_camera{0, 0, -1};      // the world's zenith: unit vector, camera frame
  std::vector<PlacedIntruder> intruders;  // far to near; equal distances by id
};

// Attitude of the platform: between two known ones by spherical linear interpolation (slerp), before the first and
// after the last as these; level where none is known.
[[nodiscard]] glm::dquat world_from_platform_at(const std::vector<PlatformAttitude>& attitudes, double time_s);

// Standard deviation of the camera's attitude, linear between two known ones; none where none is known.
[[nodiscard]] std::optional<glm::dvec3> attitude_sd_at(const std::vector<AttitudeDeviation>& deviations, double time_s);

// In how many frames of a range the camera's attitude is not known: its standard deviation is above 90 degrees. 0 where
// no deviation is known.
[[nodiscard]] int unknown_attitudes(const CameraMotion& motion, const FootageShape& footage, const FrameRange& range);

// How long the shutter is open: linear between two known ones, before the first and after the last as these; 0 where
// none is known.
[[nodiscard]] double exposure_at(const std::vector<ExposureTime>& exposures, double time_s);

// Pose of the camera: on its path or, without one, straight on along world X. Its attitude is
// world_from_platform_at(time_s) * attitude at the start. Of a camera of a rig all that is the aircraft's, and the
// camera's mount stands on its right.
[[nodiscard]] Pose<frame::World, frame::Camera> camera_at(const CameraMotion& motion, double time_s);

// Pose of an intruder against the camera at any time of the footage.
//   intruder  index in Scene::intruders
[[nodiscard]] Pose<frame::Camera, frame::Body> camera_from_body_at(const Scene& scene, std::size_t intruder,
                                                                   double time_s);

// The scene at a frame of the footage, counted from 0.
[[nodiscard]] SceneMoment scene_at(const Scene& scene, int frame);

}  // namespace sigs
