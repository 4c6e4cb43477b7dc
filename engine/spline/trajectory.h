// SPDX-License-Identifier: MIT
#pragma once

#include <glm/glm.hpp>
#include <memory>
#include <vector>

#include "base/pose.h"
#include "base/result.h"

namespace sigs {

enum class SplineKind {
  interpolating,  // the C2 cubic spline through every waypoint at its time, natural at both ends
  approximating,  // the paper's uniform cubic B-spline, equations (1) and (2): the waypoints are its control points
};

enum class Timing {
  frames,          // at the waypoints' times (approximating: only those of the first and the last one count)
  constant_speed,  // the same curve at one speed, from the first waypoint's time to the last one's
};

enum class Bank {
  coordinated,  // as in a turn without sideslip: atan(speed * turn rate / g) in a level turn
  level,        // wings level
};

struct TimedWaypoint {
  double time_s = 0;
  glm::dvec3 position_m{0, 0, 0};  // in the world
};

struct TrajectorySettings {
  SplineKind spline = SplineKind::interpolating;
  Timing timing = Timing::frames;
  Bank bank = Bank::coordinated;
  double bank_limit_rad = 1.0471975511965976;  // 60 degrees; 0..pi. Applies at moderate pitch: attitude.h
};

// Position and attitude of an intruder at any time, computed from waypoints. It depends on the time alone: calls in any
// order, on any number of threads, return the same bits. One waypoint hovers, level, with the nose along world X; two
// are joined by a straight line. All times are seconds on the waypoints' clock and must be finite.
class Trajectory {
 public:
  // waypoints  at least one, times strictly increasing (by 1e-9 s at least), everything within 1e12 m or s of zero.
  // Errors (bad_project) name the waypoint, "waypoints[3]", or "waypoints" where there is none, or "bank_limit".
  [[nodiscard]] static Result<Trajectory> make(const std::vector<TimedWaypoint>& waypoints,
                                               const TrajectorySettings& settings);

  // The trajectory that has this pose at time_s: straight on at constant velocity, the attitude always the same,
  // whatever the direction of the velocity. All numbers finite, the rotation a unit quaternion.
  [[nodiscard]] static Trajectory steady(double time_s, const Pose<frame::World, frame::Body>& world_from_body,
                                         const glm::dvec3& velocity_mps);

  // In the world. Before the first and after the last waypoint's time the flight goes on straight at constant velocity.
  // Acceleration may be discontinuous at those two times (approximating) and at corners (constant speed); at corners
  // velocity may be, too.
  [[nodiscard]] glm::dvec3 position_m(double time_s) const;
  [[nodiscard]] glm::dvec3 velocity_mps(double time_s) const;
  [[nodiscard]] glm::dvec3 acceleration_mps2(double time_s) const;

  // Position and attitude: the nose along the velocity, the bank of a coordinated turn. Continuous everywhere. Where
  // the path stands still (below 0.02 m/s), reverses or has a corner, the nose leaves the velocity and turns over, in
  // at least 0.2 s for 180 degrees. A sudden change of bank is spread over about 0.15 s.
  [[nodiscard]] Pose<frame::World, frame::Body> world_from_body(double time_s) const;

 private:
  struct Path;
  explicit Trajectory(std::shared_ptr<const Path> path);
  std::shared_ptr<const Path> path_;  // constant, so copies may share it
};

}  // namespace sigs
