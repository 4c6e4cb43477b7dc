// SPDX-License-Identifier: MIT
#include "scene/scene_at.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "scene/scene_light.h"

namespace sigs {

glm::dquat world_from_platform_at(const std::vector<PlatformAttitude>& attitudes, double time_s) {
  if (attitudes.empty()) return {1, 0, 0, 0};
  const auto after = std::upper_bound(attitudes.begin(), attitudes.end(), time_s,
                                      [](double time, const PlatformAttitude& turn) { return time < turn.time_s; });
  if (after == attitudes.begin()) return after->world_from_platform;
  const auto before = std::prev(after);
  if (after == attitudes.end() || before->time_s == time_s) return before->world_from_platform;
  const double share = (time_s - before->time_s) / (after->time_s - before->time_s);
  return glm::slerp(before->world_from_platform, after->world_from_platform, share);
}

std::optional<glm::dvec3> attitude_sd_at(const std::vector<AttitudeDeviation>& deviations, double time_s) {
  if (deviations.empty()) return std::nullopt;
  const auto after = std::upper_bound(deviations.begin(), deviations.end(), time_s,
                                      [](double time, const AttitudeDeviation& one) { return time < one.time_s; });
  if (after == deviations.begin()) return after->sd_rad;
  const auto before = std::prev(after);
  if (after == deviations.end() || before->time_s == time_s) return before->sd_rad;
  const double share = (time_s - before->time_s) / (after->time_s - before->time_s);
  glm::dvec3 sd_rad;
  for (int axis = 0; axis < 3; ++axis) {
    const double a = before->sd_rad[axis];
    const double b = after->sd_rad[axis];
    sd_rad[axis] = std::isfinite(a) && std::isfinite(b) ? glm::mix(a, b, share) : std::max(a, b);
  }
  return sd_rad;
}

int unknown_attitudes(const CameraMotion& motion, const FootageShape& footage, const FrameRange& range) {
  constexpr double kUnknown_rad = rad_of_deg(90);
  int unknown = 0;
  for (int frame = range.first; frame <= range.last && !motion.deviations.empty(); ++frame) {
    const glm::dvec3 sd_rad = *attitude_sd_at(motion.deviations, time_of_frame_s(footage, frame));
    unknown += std::max({sd_rad.x, sd_rad.y, sd_rad.z}) > kUnknown_rad ? 1 : 0;
  }
  return unknown;
}

double exposure_at(const std::vector<ExposureTime>& exposures, double time_s) {
  if (exposures.empty()) return 0;
  const auto after = std::upper_bound(exposures.begin(), exposures.end(), time_s,
                                      [](double time, const ExposureTime& one) { return time < one.time_s; });
  if (after == exposures.begin()) return after->exposure_s;
  const auto before = std::prev(after);
  if (after == exposures.end() || before->time_s == time_s) return before->exposure_s;
  const double share = (time_s - before->time_s) / (after->time_s - before->time_s);
  return glm::mix(before->exposure_s, after->exposure_s, share);
}

Pose<frame::World, frame::Camera> camera_at(const CameraMotion& motion, double time_s) {
  Pose<frame::World, frame::Camera> pose = motion.world_from_camera_at_start;
  if (motion.path)
    pose.translation_m = motion.path->motion_at(time_s).position_m;
  else
    pose.translation_m.x += motion.speed_mps * time_s;
  if (!motion.attitudes.empty()) pose.rotation = world_from_platform_at(motion.attitudes, time_s) * pose.rotation;
  return pose;
}

namespace {

// Subtracting in the world first keeps full precision where both are 1e7 m from its origin.
Pose<frame::Camera, frame::Body> seen_from(const Pose<frame::World, frame::Camera>& world_from_camera,
                                           const Pose<frame::World, frame::Body>& world_from_body) {
  const glm::dquat camera_from_world = glm::conjugate(world_from_camera.rotation);
  return {camera_from_world * world_from_body.rotation,
          camera_from_world * (world_from_body.translation_m - world_from_camera.translation_m)};
}

}  // namespace

Pose<frame::Camera, frame::Body> camera_from_body_at(const Scene& scene, std::size_t intruder, double time_s) {
  return seen_from(camera_at(scene.motion, time_s), scene.intruders[intruder].trajectory.world_from_body(time_s));
}

SceneMoment scene_at(const Scene& scene, int frame) {
  SceneMoment moment;
  moment.time_s = time_of_frame_s(scene.footage, frame);
  moment.exposure_s = exposure_at(scene.motion.exposures, moment.time_s);
  moment.world_from_camera = camera_at(scene.motion, moment.time_s);
  moment.light_in_camera = inverse(moment.world_from_camera) * scene.light.position_m;
  const glm::dquat camera_from_world = glm::conjugate(moment.world_from_camera.rotation);
  moment.up_in_camera = camera_from_world * glm::dvec3(0, 0, -1);
  if (scene.light.kind == LightKind::sun) {
    const Sunlight sun = sunlight_at(scene, moment.time_s);
    moment.to_sun_in_camera = camera_from_world * sun.to_sun;
    moment.sun_visible_share = sun.visible_share;
  }
  for (std::size_t i = 0; i < scene.intruders.size(); ++i) {
    const Pose<frame::World, frame::Body> world_from_body =
        scene.intruders[i].trajectory.world_from_body(moment.time_s);
    moment.intruders.push_back({.id = static_cast<int>(i),
                                .camera_from_body = seen_from(moment.world_from_camera, world_from_body),
                                .attitude = attitude_of(world_from_body.rotation)});
  }
  std::stable_sort(moment.intruders.begin(), moment.intruders.end(),
                   [](const PlacedIntruder& a, const PlacedIntruder& b) { return a.distance_m() > b.distance_m(); });
  return moment;
}

}  // namespace sigs
