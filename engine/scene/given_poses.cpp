// SPDX-License-Identifier: MIT
#include "scene/given_poses.h"

#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <string>
#include <utility>

namespace sigs {

namespace {

constexpr double kFarthestGiven_m = 1e8;  // as for positions of projects
constexpr double kFastestGiven_mps = 1e6;

bool lies_within(const glm::dvec3& v, double limit) {  // false for NaN
  return std::abs(v.x) <= limit && std::abs(v.y) <= limit && std::abs(v.z) <= limit;
}

Result<void> check_given(const GivenPose& pose, const std::string& body) {
  const Attitude& attitude = pose.attitude;
  if (!lies_within(pose.position_m, kFarthestGiven_m))
    return fail(body, "position_m must be three numbers, each within 1e8 m of the world's origin", ErrorKind::usage);
  if (!lies_within(pose.velocity_mps, kFastestGiven_mps))
    return fail(body, "velocity_mps must be three numbers, each within 1e6 m/s", ErrorKind::usage);
  if (!std::isfinite(attitude.roll_rad) || !std::isfinite(attitude.pitch_rad) || !std::isfinite(attitude.yaw_rad))
    return fail(body, "roll, pitch and yaw must be finite numbers", ErrorKind::usage);
  return {};
}

// What the project's motion says of rolling shutter and exposure stays.
void move_camera(CameraMotion& motion, double time_s, const GivenPose& pose) {
  constexpr double kPiece_s = 1;  // any: the path goes on as a straight line
  motion.world_from_camera_at_start = {rotation_of(pose.attitude), pose.position_m};
  motion.speed_mps = 0;
  motion.attitudes.clear();
  motion.deviations.clear();
  motion.source = {.position = "given", .attitude = "given"};
  motion.path = std::make_shared<const PiecewiseCubic>(
      std::vector<double>{time_s, time_s + kPiece_s},
      std::vector<CubicPiece>{{pose.position_m, pose.velocity_mps, glm::dvec3(0), glm::dvec3(0)}},
      pose.position_m + kPiece_s * pose.velocity_mps);
}

}  // namespace

Result<Scene> with_poses(Scene scene, int frame, const GivenPoses& poses) {
  const double time_s = time_of_frame_s(scene.footage, frame);
  if (poses.camera) {
    if (const Result<void> good = check_given(*poses.camera, "camera"); !good) return fail(good.error());
    move_camera(scene.motion, time_s, *poses.camera);
    scene.horizon_is_known = true;
  }
  const int count = static_cast<int>(scene.intruders.size());
  for (const GivenIntruderPose& given : poses.intruders) {
    const std::string body = fmt::format("intruder {}", given.intruder);
    if (given.intruder < 0 || given.intruder >= count)
      return fail(body, fmt::format("there are {} intruders, counted from 0", count), ErrorKind::usage);
    if (const Result<void> good = check_given(given.pose, body); !good) return fail(good.error());
    scene.intruders[static_cast<std::size_t>(given.intruder)].trajectory =
        Trajectory::steady(time_s, {rotation_of(given.pose.attitude), given.pose.position_m}, given.pose.velocity_mps);
  }
  return scene;
}

}  // namespace sigs
