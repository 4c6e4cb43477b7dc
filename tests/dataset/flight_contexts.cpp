// SPDX-License-Identifier: MIT
#include "dataset/flight_contexts.h"

#include <stdexcept>

#include "base/pose.h"
#include "scene/scene_at.h"
#include "scene/scene_parts.h"

namespace sigs::test {

namespace {

Camera camera_of(LensModel model, double focal_px, std::vector<double> coefficients) {
  const cv::Size size_px(1280, 960);
  Result<Lens> lens = Lens::make({.model = model,
                                  .fx = focal_px,
                                  .fy = focal_px * 1.01,
                                  .cx = 644,
                                  .cy = 471,
                                  .coefficients = std::move(coefficients)});
  if (!lens) throw std::runtime_error(lens.error().text());
  return {*std::move(lens), size_px};
}

CameraMotion motion_of(const FlightContext& context) {
  CameraMotion motion;
  motion.world_from_camera_at_start = {rotation_of({.roll_rad = rad_of_deg(context.camera.roll_deg.value_or(0)),
                                                    .pitch_rad = rad_of_deg(context.camera.pitch_deg.value_or(0)),
                                                    .yaw_rad = rad_of_deg(context.camera.yaw_deg)}),
                                       context.camera.position_m};
  motion.speed_mps = context.camera.speed_mps;
  return motion;
}

}  // namespace

std::vector<NamedLens> example_lenses() {
  return {{"pinhole", camera_of(LensModel::brown_conrady, 700, {})},
          {"telephoto", camera_of(LensModel::brown_conrady, 9000, {})},
          {"barrel", camera_of(LensModel::brown_conrady, 560, {-0.25, 0.06, 0.001, -0.0005})},
          {"action camera", camera_of(LensModel::kannala_brandt, 561.5, {0.0432, 0.0115, -0.0104, 0.0021})},
          {"whole fisheye", camera_of(LensModel::kannala_brandt, 300, {0, 0, 0, 0})}};
}

FootageShape footage_of(int frames, double jitter_s) {
  FootageShape footage{.size_px = {1280, 960}};
  for (int i = 0; i < frames; ++i) footage.times_s.push_back(i * 0.04 + (i % 3 == 2 ? jitter_s : 0));
  return footage;
}

std::map<std::string, double> values_with(FlightKind kind, const std::map<std::string, double>& given) {
  std::map<std::string, double> values = given;
  for (const FlightQuantity& quantity : quantities_of(kind))
    if (quantity.standard) values.emplace(quantity.name, *quantity.standard);
  return values;
}

glm::dvec3 relative_position_m(const FlightContext& context, const Trajectory& trajectory, double time_s) {
  return trajectory.position_m(time_s) - camera_at(motion_of(context), time_s).translation_m;
}

Trajectory trajectory_of(const FlightContext& context, const PlannedFlight& flight) {
  Result<Trajectory> trajectory =
      Trajectory::make(timed_waypoints(flight.waypoints, context.footage, context.frames.first, context.frames.last),
                       TrajectorySettings{});
  if (!trajectory) throw std::runtime_error(trajectory.error().text());
  return *std::move(trajectory);
}

glm::dvec3 in_camera(const FlightContext& context, const glm::dvec3& in_world_from_camera) {
  return glm::conjugate(motion_of(context).world_from_camera_at_start.rotation) * in_world_from_camera;
}

}  // namespace sigs::test
