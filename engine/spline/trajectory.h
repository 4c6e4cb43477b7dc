// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <memory>
#include <span>
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

enum class AttitudeKind {
  path,        // the nose along the velocity, banked as Bank says: airplanes, gliders, birds
  helicopter,  // the others: attitude.h
  multirotor,
  balloon,  // level
};

struct TimedHeading {
  double time_s = 0;
  double heading_rad = 0;  // of the nose, from world X to the right
};

struct TimedWaypoint {
  double time_s = 0;
  glm::dvec3 position_m{0, 0, 0};  // in the world
};

struct TrajectorySettings {
  SplineKind spline = SplineKind::interpolating;
  Timing timing = Timing::frames;
  AttitudeKind attitude = AttitudeKind::path;
  Bank bank = Bank::coordinated;               // of AttitudeKind::path
  double bank_limit_rad = 1.0471975511965976;  // 60 degrees; 0..pi. Applies at moderate pitch: attitude.h
  std::vector<TimedHeading> headings = {};  // of the other kinds; finite, times strictly increasing; none: the path's
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

  // Position and attitude. Of AttitudeKind::path the nose along the velocity, the bank of a coordinated turn.
  // Continuous everywhere. Where the path stands still (below 0.02 m/s), reverses or has a corner, the nose leaves the
  // velocity and turns over, in at least 0.2 s for 180 degrees. A sudden change of bank is spread over about 0.15 s.
  [[nodiscard]] Pose<frame::World, frame::Body> world_from_body(double time_s) const;

 private:
  struct Path;
  explicit Trajectory(std::shared_ptr<const Path> path);
  std::shared_ptr<const Path> path_;  // constant, so copies may share it
};

// How well waypoints and their times suit the interpolating spline. Where legs have very different durations, a short
// leg ends with a speed that carries the curve far away during the long leg that follows.

// The condition number of the interpolation: the greatest distance that the curve moves, anywhere between the first and
// the last waypoint, when each waypoint moves by at most 1 m (along one axis; each axis is a spline of its own). It is
// the Lebesgue constant of the natural cubic spline, the maximum of the sum of the magnitudes of its cardinal functions
// (de Boor, A Practical Guide to Splines, chapter II): 1 for one or two waypoints, 1.2 to 2 for even times, about 0.38
// times the ratio of two neighbouring durations where that ratio is large. Too small by 0.5 % at most, because it is
// evaluated at samples. Waypoints as for interpolating_spline(); positions do not matter. O(n).
[[nodiscard]] double interpolation_condition(std::span<const TimedWaypoint> waypoints);

// A leg on which the interpolating spline departs far from its waypoints.
struct Overshoot {
  std::size_t leg = 0;     // from waypoint `leg` to the next one
  double overshoot_m = 0;  // greatest distance of the curve from the straight line between the two
  double max_leg_m = 0;    // straight length of the longest of the leg and its two neighbours
};

// The legs with overshoot_m > max_leg_m, in order. Overshoots below a hundredth of the longest leg of all are left out.
// overshoot_m is evaluated at 64 moments of each leg, which makes it too small by 0.1 % at most.
[[nodiscard]] std::vector<Overshoot> overshoots_of(std::span<const TimedWaypoint> waypoints);

}  // namespace sigs
