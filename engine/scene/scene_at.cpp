// SPDX-License-Identifier: MIT
#include "scene/scene_at.h"

#include <algorithm>
#include <iterator>

namespace sigs {

glm::dquat world_from_carrier_at(const std::vector<CarrierAttitude>& turns, double time_s) {
  if (turns.empty()) return {1, 0, 0, 0};
  const auto after = std::upper_bound(turns.begin(), turns.end(), time_s,
                                      [](double time, const CarrierAttitude& turn) { return time < turn.time_s; });
  if (after == turns.begin()) return after->world_from_carrier;
  const auto before = std::prev(after);
  if (after == turns.end() || before->time_s == time_s) return before->world_from_carrier;
  const double share = (time_s - before->time_s) / (after->time_s - before->time_s);
  return glm::slerp(before->world_from_carrier, after->world_from_carrier, share);
}

Pose<frame::World, frame::Camera> camera_at(const CameraMotion& motion, double time_s) {
  Pose<frame::World, frame::Camera> pose = motion.world_from_camera_at_start;
  pose.translation_m.x += motion.speed_mps * time_s;
  if (!motion.turns.empty()) pose.rotation = world_from_carrier_at(motion.turns, time_s) * pose.rotation;
  return pose;
}

SceneMoment scene_at(const Scene& scene, int frame) {
  SceneMoment moment;
  moment.time_s = time_of_frame_s(scene.footage, frame);
  moment.world_from_camera = camera_at(scene.motion, moment.time_s);
  const Pose<frame::Camera, frame::World> camera_from_world = inverse(moment.world_from_camera);
  moment.light_in_camera = camera_from_world * scene.light.position_m;
  for (std::size_t i = 0; i < scene.intruders.size(); ++i) {
    const Pose<frame::World, frame::Body> world_from_body =
        scene.intruders[i].trajectory.world_from_body(moment.time_s);
    // Subtracting in the world first keeps full precision where both are 1e7 m from its origin.
    const glm::dvec3 from_camera_in_world = world_from_body.translation_m - moment.world_from_camera.translation_m;
    moment.intruders.push_back({.id = static_cast<int>(i),
                                .camera_from_body = {camera_from_world.rotation * world_from_body.rotation,
                                                     camera_from_world.rotation * from_camera_in_world},
                                .attitude = attitude_of(world_from_body.rotation)});
  }
  std::stable_sort(moment.intruders.begin(), moment.intruders.end(),
                   [](const PlacedIntruder& a, const PlacedIntruder& b) { return a.distance_m() > b.distance_m(); });
  return moment;
}

}  // namespace sigs
