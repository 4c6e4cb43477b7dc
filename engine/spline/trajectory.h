// SPDX-License-Identifier: MIT
#pragma once

#include <glm/glm.hpp>
#include <memory>
#include <vector>

#include "base/pose.h"
#include "base/result.h"

namespace sigs {

enum class SplineKind { interpolating, approximating };
enum class Timing { frames, constant_speed };
enum class Bank { coordinated, level };

struct TimedWaypoint {
  double time_s = 0;
  glm::dvec3 position_m{0, 0, 0};  // in the world
};

struct TrajectorySettings {
  SplineKind spline = SplineKind::interpolating;
  Timing timing = Timing::frames;
  Bank bank = Bank::coordinated;
  double bank_limit_rad = 1.0471975511965976;  // 60 degrees
};

// Where an intruder is at any time, and how it lies in the air. A function of time alone.
class Trajectory {
 public:
  // waypoints: at least one, times strictly increasing, everything finite. Errors name the waypoint: "waypoints[3]".
  [[nodiscard]] static Result<Trajectory> make(const std::vector<TimedWaypoint>& waypoints,
                                               const TrajectorySettings& settings);

  // In the world; before the first and after the last waypoint's time the flight goes straight on at constant velocity.
  [[nodiscard]] glm::dvec3 position_m(double time_s) const;
  [[nodiscard]] glm::dvec3 velocity_mps(double time_s) const;
  [[nodiscard]] glm::dvec3 acceleration_mps2(double time_s) const;

  // Position, and the attitude that the path asks for: nose along the velocity, bank of a coordinated turn.
  [[nodiscard]] Pose<frame::World, frame::Body> world_from_body(double time_s) const;

 private:
  struct Path;
  explicit Trajectory(std::shared_ptr<const Path> path);
  std::shared_ptr<const Path> path_;  // never changes once made, so copies may share it
};

}  // namespace sigs
