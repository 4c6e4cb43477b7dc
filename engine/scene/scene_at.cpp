// SPDX-License-Identifier: MIT
#include "scene/scene_at.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "base/interpolation.h"
#include "scene/scene_light.h"

namespace sigs {

FootageShape shape_of(const VideoInfo& video) {
  return {.size_px = video.size_px,
          .part = video.part,
          .times_s = video.times_s,
          .frame_interval_s = double(video.frame_rate_den) / video.frame_rate_num};
}

double time_of_frame_s(const FootageShape& footage, double frame) {
  const std::vector<double>& times_s = footage.times_s;
  const double last = static_cast<double>(times_s.size()) - 1;
  if (times_s.empty()) return frame * footage.frame_interval_s;
  if (frame <= 0) return times_s.front() + frame * footage.frame_interval_s;
  if (frame >= last) return times_s.back() + (frame - last) * footage.frame_interval_s;
  const double whole = std::floor(frame);
  const double share = frame - whole;
  const auto index = static_cast<std::size_t>(whole);
  return share == 0 ? times_s[index] : times_s[index] + share * (times_s[index + 1] - times_s[index]);
}

double frame_at_time(const FootageShape& footage, double time_s) {
  const std::vector<double>& times_s = footage.times_s;
  if (times_s.empty()) return time_s / footage.frame_interval_s;
  if (time_s <= times_s.front()) return (time_s - times_s.front()) / footage.frame_interval_s;
  const auto after = std::lower_bound(times_s.begin(), times_s.end(), time_s);
  const double last = static_cast<double>(times_s.size()) - 1;
  if (after == times_s.end()) return last + (time_s - times_s.back()) / footage.frame_interval_s;
  const auto frame = static_cast<double>(after - times_s.begin());
  return frame - (*after - time_s) / (*after - *std::prev(after));
}

Camera compositing_camera(const Scene& scene) {
  if (scene.compositing.method != MethodChoice::plain) return scene.camera;
  return {scene.camera.lens.pinhole(), scene.camera.size_px};
}

namespace {

// What samples have at a time (base/interpolation.h).
template <class Sample, class Value>
Value value_of(const std::vector<Sample>& samples, Value Sample::*value, double time_s) {
  const Neighbours at = neighbours_of(samples, time_s, &Sample::time_s);
  const Value& before = samples[at.before].*value;
  return at.before == at.after ? before : interpolated(before, samples[at.after].*value, at.share);
}

}  // namespace

glm::dquat world_from_platform_at(const std::vector<PlatformAttitude>& attitudes, double time_s) {
  if (attitudes.empty()) return {1, 0, 0, 0};
  return value_of(attitudes, &PlatformAttitude::world_from_platform, time_s);
}

std::optional<glm::dvec3> attitude_sd_at(const std::vector<AttitudeDeviation>& deviations, double time_s) {
  if (deviations.empty()) return std::nullopt;
  const Neighbours at = neighbours_of(deviations, time_s, &AttitudeDeviation::time_s);
  glm::dvec3 sd_rad = deviations[at.before].sd_rad;
  for (int axis = 0; axis < 3 && at.before != at.after; ++axis) {
    const double after = deviations[at.after].sd_rad[axis];
    const bool is_known = std::isfinite(sd_rad[axis]) && std::isfinite(after);
    sd_rad[axis] = is_known ? interpolated(sd_rad[axis], after, at.share) : std::max(sd_rad[axis], after);
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
  return exposures.empty() ? 0 : value_of(exposures, &ExposureTime::exposure_s, time_s);
}

Pose<frame::World, frame::Camera> camera_at(const CameraMotion& motion, double time_s) {
  Pose<frame::World, frame::Camera> pose = motion.world_from_camera_at_start;
  if (motion.path)
    pose.translation_m = motion.path->motion_at(time_s).position_m;
  else
    pose.translation_m.x += motion.speed_mps * time_s;
  if (!motion.attitudes.empty()) pose.rotation = world_from_platform_at(motion.attitudes, time_s) * pose.rotation;
  if (!motion.mount) return pose;
  return Pose<frame::World, frame::Body>{pose.rotation, pose.translation_m} * *motion.mount;
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
                                .world_from_body = world_from_body.rotation});
  }
  std::stable_sort(moment.intruders.begin(), moment.intruders.end(),
                   [](const PlacedIntruder& a, const PlacedIntruder& b) { return a.distance_m() > b.distance_m(); });
  return moment;
}

}  // namespace sigs
