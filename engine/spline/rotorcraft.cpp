// SPDX-License-Identifier: MIT
#include "spline/rotorcraft.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "base/pose.h"
#include "spline/attitude.h"
#include "spline/directions.h"

namespace sigs {
namespace {

constexpr double kFollow_s = 0.5;
constexpr double kStep_s = 0.04;
constexpr double kMaxSteps = 20'000;
constexpr double kSlow_mps = 0.5;  // below, the path has no heading
constexpr double kClear_mps = 2;   // from here on it counts in full
constexpr double kMinLift = 0.2;   // of gravity

// Of drag, 1/m.
double drag_of(AttitudeKind kind) {
  if (kind == AttitudeKind::helicopter) return 2.4e-4;
  return kind == AttitudeKind::multirotor ? 0.020 : 0.0;
}

double first_s_of(const TimedCurve& timed_curve) {
  return std::visit([](const auto& timed) { return timed.first_s(); }, timed_curve);
}

double last_s_of(const TimedCurve& timed_curve) {
  return std::visit([](const auto& timed) { return timed.last_s(); }, timed_curve);
}

DesiredRoll path_heading(double time_s, const glm::dvec3& velocity_mps) {
  const double speed_mps = std::hypot(velocity_mps.x, velocity_mps.y);
  const double weight = std::clamp((speed_mps - kSlow_mps) / (kClear_mps - kSlow_mps), 0.0, 1.0);
  return {time_s, std::atan2(velocity_mps.y, velocity_mps.x), weight};
}

// headings: at least one.
DesiredRoll given_heading(double time_s, std::span<const TimedHeading> headings) {
  const auto after = std::upper_bound(headings.begin(), headings.end(), time_s,
                                      [](double value, const TimedHeading& heading) { return value < heading.time_s; });
  if (after == headings.begin()) return {time_s, headings.front().heading_rad, 1};
  const TimedHeading& before = *std::prev(after);
  if (after == headings.end()) return {time_s, before.heading_rad, 1};
  const double share = (time_s - before.time_s) / (after->time_s - before.time_s);
  const double turn_rad = std::remainder(after->heading_rad - before.heading_rad, 2 * std::numbers::pi);
  return {time_s, before.heading_rad + share * turn_rad, 1};
}

// Roll, pitch and yaw with which the thrust gives the motion.
glm::dvec3 angles_of(const Motion& motion, double heading_rad, const TrajectorySettings& settings) {
  if (settings.attitude == AttitudeKind::balloon) return {0, 0, heading_rad};
  const glm::dvec3 drag_mps2 = drag_of(settings.attitude) * glm::length(motion.velocity_mps) * motion.velocity_mps;
  const glm::dvec3 force_mps2 = specific_force_mps2(motion) + drag_mps2;
  const double ahead = std::cos(heading_rad) * force_mps2.x + std::sin(heading_rad) * force_mps2.y;
  const double right = std::cos(heading_rad) * force_mps2.y - std::sin(heading_rad) * force_mps2.x;
  const double lift = std::max(-force_mps2.z, kMinLift * kGravity_mps2);
  const double limit_rad = std::min(settings.bank_limit_rad, 0.49 * std::numbers::pi);
  const double pitch_rad = std::clamp(-std::atan2(ahead, lift), -limit_rad, limit_rad);
  const double roll_rad = std::clamp(std::atan2(right, std::hypot(ahead, lift)), -limit_rad, limit_rad);
  return {roll_rad, pitch_rad, heading_rad};
}

std::vector<double> smoothed(const std::vector<TimedWaypoint>& angles, int axis) {
  std::vector<DesiredRoll> desired;
  for (const TimedWaypoint& one : angles) desired.push_back({one.time_s, one.position_m[axis], 1});
  return smoothed_roll_rad(desired, kFollow_s);
}

// Angles in place of a position: the spline through them is as smooth.
PiecewiseCubic angles_along(const TimedCurve& timed_curve, const TrajectorySettings& settings) {
  const double first_s = first_s_of(timed_curve);
  const double duration_s = last_s_of(timed_curve) - first_s;
  const auto steps = static_cast<std::size_t>(std::clamp(std::ceil(duration_s / kStep_s), 1.0, kMaxSteps));
  const double step_s = duration_s > 0 ? duration_s / static_cast<double>(steps) : 1.0;  // one waypoint hovers
  std::vector<DesiredRoll> headings;
  for (std::size_t i = 0; i <= steps; ++i) {
    const double time_s = first_s + step_s * static_cast<double>(i);
    headings.push_back(settings.headings.empty() ? path_heading(time_s, motion_at(timed_curve, time_s).velocity_mps)
                                                 : given_heading(time_s, settings.headings));
  }
  const std::vector<double> heading_rad = smoothed_roll_rad(headings, kFollow_s);
  std::vector<TimedWaypoint> angles;
  for (std::size_t i = 0; i <= steps; ++i)
    angles.push_back(
        {headings[i].time_s, angles_of(motion_at(timed_curve, headings[i].time_s), heading_rad[i], settings)});
  const std::vector<double> roll_rad = smoothed(angles, 0);
  const std::vector<double> pitch_rad = smoothed(angles, 1);
  for (std::size_t i = 0; i <= steps; ++i) angles[i].position_m = {roll_rad[i], pitch_rad[i], heading_rad[i]};
  return interpolating_spline(angles);
}

}  // namespace

RotorcraftAttitude::RotorcraftAttitude(const TimedCurve& timed_curve, const TrajectorySettings& settings)
    : angles_(angles_along(timed_curve, settings)) {}

glm::dquat RotorcraftAttitude::world_from_body(double time_s) const {
  const double inside_s = std::clamp(time_s, angles_.first_s(), angles_.last_s());
  const glm::dvec3 angles = angles_.motion_at(inside_s).position_m;
  return rotation_of({angles.x, angles.y, angles.z});
}

}  // namespace sigs
