// SPDX-License-Identifier: MIT
#include "scene/posed_intruder.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <string>

#include "base/ensure.h"
#include "scene/opened_project.h"
#include "scene/scene_light.h"

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
  motion.mount.reset();
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

namespace {

constexpr int kMinAround = 24;       // before and after the frame: path and camera are laid out
constexpr double kNearAspect = 0.1;  // logarithm of the ratio to the wanted aspect
constexpr double kStep_rad = std::numbers::pi / 24;
constexpr double kMinGrowth_per_s = 0.02;  // below it, any nose does: it hardly moves
constexpr double kMinRadial = 0.3;         // of a flight that is to change the size, as share of its speed
constexpr double kMinSpeed_mps = 1;        // so that the path has a direction

// A direction from which an intruder with level wings is seen, and its box from there at a distance of 1 m times the
// focal length, in metres.
struct View {
  double elevation_rad = 0;  // of the line of sight
  double yaw_rad = 0;        // of the nose, from the line of sight to the right
  cv::Rect2d box_m;          // right and down

  [[nodiscard]] double aspect() const { return box_m.width / box_m.height; }

  // How fast the distance grows, as share of the speed along the nose.
  [[nodiscard]] double radial() const { return std::cos(elevation_rad) * std::cos(yaw_rad); }
};

glm::dvec3 along(double heading_rad, double elevation_rad) {
  return {std::cos(elevation_rad) * std::cos(heading_rad), std::cos(elevation_rad) * std::sin(heading_rad),
          -std::sin(elevation_rad)};
}

View view_from(const std::vector<glm::vec3>& points_m, double elevation_rad, double yaw_rad) {
  cv::Point2d low(1e300, 1e300), high(-1e300, -1e300);
  for (const glm::dvec3 point : points_m) {
    const glm::dvec3 turned = glm::angleAxis(yaw_rad, glm::dvec3(0, 0, 1)) * point;
    const cv::Point2d at(turned.y, std::sin(elevation_rad) * turned.x + std::cos(elevation_rad) * turned.z);
    low = {std::min(low.x, at.x), std::min(low.y, at.y)};
    high = {std::max(high.x, at.x), std::max(high.y, at.y)};
  }
  return {elevation_rad, yaw_rad, cv::Rect2d(low, high)};
}

// The smallest turn that takes one unit vector to another, which is not opposite.
glm::dquat turn_between(const glm::dvec3& from, const glm::dvec3& to) {
  return glm::normalize(glm::dquat(1 + glm::dot(from, to), glm::cross(from, to)));
}

// Whether flying along the nose can change the size as the pose wants it.
bool can_grow_so(const View& view, const IntruderPose& pose) {
  if (std::abs(pose.growth_per_s.value_or(0)) < kMinGrowth_per_s) return true;
  return std::abs(view.radial()) >= kMinRadial && (*pose.growth_per_s > 0) == (view.radial() < 0);
}

// The distance d changes by radial * speed, the size, which goes with 1 / d, by -radial * speed / d.
double speed_of(const View& view, const IntruderPose& pose, double distance_m) {
  if (!pose.growth_per_s) return pose.speed_mps;
  if (std::abs(*pose.growth_per_s) < kMinGrowth_per_s) return kMinSpeed_mps;
  return std::max(kMinSpeed_mps, -*pose.growth_per_s * distance_m / view.radial());
}

// One of those whose aspect is near the wanted one, else the nearest.
View chosen_view(const std::vector<glm::vec3>& points_m, const IntruderPose& pose) {
  std::vector<View> near;
  View nearest;
  double least = 1e300;
  for (double elevation = pose.lowest_rad; elevation <= pose.highest_rad; elevation += kStep_rad)
    for (double yaw = 0; yaw < 2 * std::numbers::pi; yaw += kStep_rad) {
      const View view = view_from(points_m, elevation, yaw);
      if (!can_grow_so(view, pose)) continue;
      const double off = pose.aspect > 0 ? std::abs(std::log(view.aspect() / pose.aspect)) : 0;
      if (off < kNearAspect) near.push_back(view);
      if (off < least) {
        least = off;
        nearest = view;
      }
    }
  ENSURE(least < 1e300);
  return near.empty() ? nearest : near[pose.seed * std::size_t{2654435761} % near.size()];
}

// Where it is against the pose's middle, some frames before or after the pose's frame.
cv::Point2d offset_px(const IntruderPose& pose, int frames) {
  const int reach = static_cast<int>(pose.path_px.size()) / 2;
  if (pose.path_px.empty()) return frames * pose.step_px;
  const int known = std::clamp(frames, -reach, reach);
  return pose.path_px[static_cast<std::size_t>(known + reach)] + (frames - known) * pose.step_px;
}

// The project that posed_scene() opens, its intruder somewhere.
Project bare_project(const Project& project) {
  Project bare = project;
  bare.rig_view.reset();
  bare.footage.own_body_mask.clear();
  bare.footage.occluder_mask.clear();
  bare.footage.cloud_distance_m.reset();
  bare.footage.first_frame = 0;
  bare.footage.last_frame.reset();
  bare.intruders.resize(1);
  bare.intruders.front().trajectory = {};
  bare.intruders.front().trajectory.waypoints = {{.position_m = {1000, 0, -1000}}};
  bare.camera = {.position_m = project.camera.position_m, .exposure_s = project.camera.exposure_s};
  bare.camera.roll_deg = 0;
  bare.camera.pitch_deg = 0;
  return bare;
}

// The sun of a frame, where the project leaves its direction to time and place of a log, which a bare project lacks.
Result<void> keep_sun(const Project& project, const FootageShape& footage, SceneFiles& files, int frame,
                      Project& bare) {
  SunSettings& sun = bare.light.sun;
  if (bare.light.kind != LightKind::sun || (sun.azimuth_deg && sun.elevation_deg)) return {};
  const Result<Scene> scene = open_scene(project, footage, files);
  if (!scene) return fail(scene.error());
  const glm::dvec3 to_sun = sunlight_at(*scene, time_of_frame_s(footage, frame)).to_sun;
  sun.azimuth_deg = deg_of_rad(std::atan2(to_sun.y, to_sun.x));
  sun.elevation_deg = deg_of_rad(std::asin(std::clamp(-to_sun.z, -1.0, 1.0)));
  return {};
}

}  // namespace

Result<Scene> posed_scene(const Project& project, const FootageShape& footage, SceneFiles& files, int frame,
                          const IntruderPose& pose) {
  if (project.intruders.empty())
    return fail(project.file.string() + ": intruders", "is empty; name one with its model", ErrorKind::usage);
  Project bare = bare_project(project);
  if (const Result<void> kept = keep_sun(project, footage, files, frame, bare); !kept) return fail(kept.error());
  const Result<Scene> first = open_scene(bare, footage, files);
  if (!first) return fail(first.error());
  const Lens& lens = first->camera.lens;
  const View view = chosen_view(first->intruders.front().model->outermost_m, pose);
  const auto middle = lens.ray({pose.middle_px.x, pose.middle_px.y});
  if (!middle)
    return fail(project.footage.calibration, "has no ray for a pixel at which an intruder is wanted",
                ErrorKind::bad_project);
  const double distance_m = lens.pixels_per_radian(*middle) * view.box_m.width / pose.width_px;
  const double m_per_px = view.box_m.width / pose.width_px;
  const cv::Point2d box_middle_m = 0.5 * (view.box_m.tl() + view.box_m.br());
  const cv::Point2d reference_px = pose.middle_px - box_middle_m / m_per_px;

  const glm::dvec3 start_m = project.camera.position_m;
  const glm::dvec3 there_m = start_m + distance_m * along(0, view.elevation_rad);
  const int around = std::max(kMinAround, static_cast<int>(pose.path_px.size()) / 2 + 1);
  const double middle_s = time_of_frame_s(footage, frame);
  const double speed_mps = speed_of(view, pose, distance_m);
  const auto position_at = [&](double time_s) {
    return there_m + speed_mps * (time_s - middle_s) * along(view.yaw_rad, 0);
  };
  std::vector<WaypointSettings>& waypoints = bare.intruders.front().trajectory.waypoints;
  waypoints.clear();
  for (const int n : {frame - around, frame + around})
    waypoints.push_back({.frame = n, .position_m = position_at(time_of_frame_s(footage, n))});
  Result<Scene> scene = open_scene(bare, footage, files);
  if (!scene) return scene;
  for (int n = frame - around; n <= frame + around; ++n) {
    const cv::Point2d at = reference_px + offset_px(pose, n - frame);
    const auto ray = lens.ray({at.x, at.y});
    if (!ray) continue;
    const double time_s = time_of_frame_s(footage, n);
    const glm::dvec3 towards = glm::normalize(position_at(time_s) - start_m);
    // The camera without roll as far as it can be, then the small turn that is left.
    const glm::dquat level = glm::angleAxis(view.elevation_rad - std::asin(-ray->z), glm::dvec3(0, 1, 0));
    const glm::dquat turn = turn_between(level * *ray, towards) * level;
    scene->motion.attitudes.push_back({.time_s = time_s, .world_from_platform = turn});
  }
  return scene;
}

}  // namespace sigs
