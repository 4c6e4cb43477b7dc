// SPDX-License-Identifier: MIT
#include "spline/trajectory.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <variant>

#include "base/ensure.h"
#include "spline/attitude.h"
#include "spline/constant_speed.h"
#include "spline/splines.h"

namespace sigs {

namespace {

constexpr double kFarthest_m = 1e12;  // a double still counts tenths of a millimetre there
constexpr double kLatest_s = 1e12;
constexpr double kMinLeg_s = 1e-9;

bool within(const glm::dvec3& v, double limit) {  // false for NaN
  return std::abs(v.x) <= limit && std::abs(v.y) <= limit && std::abs(v.z) <= limit;
}

std::optional<std::string> mistake_in(const TimedWaypoint& waypoint, const TimedWaypoint* before) {
  if (!within(waypoint.position_m, kFarthest_m))
    return "position must be three numbers, each within 1e12 m of the origin";
  if (!(std::abs(waypoint.time_s) <= kLatest_s)) return "time must be a number of seconds within 1e12";
  if (before && !(waypoint.time_s - before->time_s >= kMinLeg_s))
    return fmt::format("time {:f} s must be later than that of the waypoint before, {:f} s", waypoint.time_s,
                       before->time_s);
  return std::nullopt;
}

Result<void> checked(const std::vector<TimedWaypoint>& waypoints, const TrajectorySettings& settings) {
  if (waypoints.empty()) return fail("waypoints", "a trajectory needs at least one waypoint", ErrorKind::bad_project);
  for (std::size_t i = 0; i < waypoints.size(); ++i)
    if (const auto mistake = mistake_in(waypoints[i], i > 0 ? &waypoints[i - 1] : nullptr))
      return fail(fmt::format("waypoints[{}]", i), *mistake, ErrorKind::bad_project);
  if (!(settings.bank_limit_rad >= 0 && settings.bank_limit_rad <= std::numbers::pi))
    return fail("bank_limit", "must lie between 0 and 180 degrees", ErrorKind::bad_project);
  return {};
}

TimedCurve timed_curve_of(const std::vector<TimedWaypoint>& waypoints, const TrajectorySettings& settings) {
  PiecewiseCubic curve =
      settings.spline == SplineKind::interpolating ? interpolating_spline(waypoints) : approximating_spline(waypoints);
  if (settings.timing == Timing::frames) return curve;
  return ConstantSpeed(std::move(curve));
}

}  // namespace

struct Trajectory::Path {
  TimedCurve timed_curve;
  std::variant<AttitudeTable, glm::dquat> attitude;  // the latter: the same at all times

  Path(TimedCurve timed, const TrajectorySettings& settings)
      : timed_curve(std::move(timed)), attitude(AttitudeTable(timed_curve, settings.bank, settings.bank_limit_rad)) {}
  Path(TimedCurve timed, const glm::dquat& world_from_body)
      : timed_curve(std::move(timed)), attitude(world_from_body) {}
};

Trajectory::Trajectory(std::shared_ptr<const Path> path) : path_(std::move(path)) {}

Result<Trajectory> Trajectory::make(const std::vector<TimedWaypoint>& waypoints, const TrajectorySettings& settings) {
  if (const Result<void> good = checked(waypoints, settings); !good) return fail(good.error());
  return Trajectory(std::make_shared<const Path>(timed_curve_of(waypoints, settings), settings));
}

Trajectory Trajectory::steady(double time_s, const Pose<frame::World, frame::Body>& world_from_body,
                              const glm::dvec3& velocity_mps) {
  constexpr double kPiece_s = 1;  // any: the curve goes on as a straight line
  const glm::dvec3& from_m = world_from_body.translation_m;
  PiecewiseCubic line({time_s, time_s + kPiece_s}, {CubicPiece{from_m, velocity_mps, glm::dvec3(0), glm::dvec3(0)}},
                      from_m + kPiece_s * velocity_mps);
  return Trajectory(std::make_shared<const Path>(TimedCurve(std::move(line)), world_from_body.rotation));
}

glm::dvec3 Trajectory::position_m(double time_s) const {
  return motion_at(path_->timed_curve, time_s).position_m;
}

glm::dvec3 Trajectory::velocity_mps(double time_s) const {
  return motion_at(path_->timed_curve, time_s).velocity_mps;
}

glm::dvec3 Trajectory::acceleration_mps2(double time_s) const {
  return motion_at(path_->timed_curve, time_s).acceleration_mps2;
}

Pose<frame::World, frame::Body> Trajectory::world_from_body(double time_s) const {
  ENSURE(std::isfinite(time_s));
  const Motion motion = motion_at(path_->timed_curve, time_s);
  if (const auto* const always = std::get_if<glm::dquat>(&path_->attitude)) return {*always, motion.position_m};
  return {std::get<AttitudeTable>(path_->attitude).world_from_body(time_s, motion.velocity_mps), motion.position_m};
}

}  // namespace sigs
