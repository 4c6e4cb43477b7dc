// SPDX-License-Identifier: MIT
#pragma once

#include <glm/gtc/quaternion.hpp>
#include <span>
#include <vector>

#include "spline/constant_speed.h"
#include "spline/directions.h"
#include "spline/trajectory.h"

namespace sigs {

// The attitude of an aircraft along a curve: nose (directions.h), the direction in which its up axis should point, and
// the roll that follows from it. It is computed once for the whole flight; after that it depends on the time alone and
// is continuous in it everywhere.
//
// Direction of the up axis. Bank::coordinated: along the specific force, so that nothing pulls sideways; in a level
// turn the bank is atan(speed * turn rate / g), right wing down in a right turn. The bank is limited to bank_limit_rad
// where the pitch is below 60 degrees; above, the limit widens, and from 75 degrees on there is none. The aircraft is
// inverted only over the top of a loop: between two passages through such steep pitch, or before the first and after
// the last one, where the force points down on the whole (the limit then counts from inverted). A flight that never
// gets that steep stays upright and pushes, however sharply its path bends down. Bank::level: wings level.
//
// Roll is counted from an up vector that is carried along with the nose and never rolls by itself (parallel transport).
// An up vector taken from the vertical would not work where the nose points straight up, and one taken from the force
// would not work where there is none. Between two entries of the table that vector is carried on to the exact direction
// of the velocity, so the spacing of the table does not show in the nose.
class AttitudeTable {
 public:
  AttitudeTable(const TimedCurve& timed_curve, Bank bank, double bank_limit_rad);

  // Unit quaternion from body to world. velocity_mps is the curve's at that time.
  [[nodiscard]] glm::dquat world_from_body(double time_s, const glm::dvec3& velocity_mps) const;

 private:
  struct Entry {
    double time_s;
    glm::dvec3 nose;
    glm::dvec3 transported_up;  // unit, perpendicular to the nose
    double roll_rad;            // from transported_up, right wing down
  };

  AttitudeTable(const TimedCurve& timed_curve, const PathSamples& path_samples, Bank bank, double bank_limit_rad);
  [[nodiscard]] double roll_rad_at(std::size_t before, double time_s) const;
  [[nodiscard]] double roll_rate_at_entry(std::size_t i) const;
  [[nodiscard]] double roll_rate_between(std::size_t i) const;

  Nose nose_;
  std::vector<Entry> entries_;  // at least two
};

// The attitude of an aircraft that hangs below what carries it: a helicopter, a multirotor, a balloon. Its heading is
// free of the path, and it tilts until the thrust along its up axis gives the path's acceleration, against gravity and
// drag: nose down to accelerate and to hold a speed, nose up to slow down, into a turn.
//
//   heading  between two given headings along the shorter way, before the first and after the last as these; where none
//            is given, that of the path, held where the path is slower than 0.5 m/s or vertical
//   tilt     the up axis along acceleration - gravity + drag, drag = factor * speed^2 against the velocity, in still
//            air; pitch and roll each within the limit. A path that falls faster than 0.8 g tilts it no further.
//   smooth   sudden changes are spread over about 0.5 s
//
// The drag factors are guesses: a helicopter flies 5 degrees nose down at 60 m/s, a multirotor 25 degrees at 15 m/s.
class RotorcraftAttitude {
 public:
  // settings.attitude is not AttitudeKind::path; settings.headings have times that strictly increase.
  RotorcraftAttitude(const TimedCurve& timed_curve, const TrajectorySettings& settings);

  // Unit quaternion from body to world. Before the first and after the last waypoint that of the first or last.
  [[nodiscard]] glm::dquat world_from_body(double time_s) const;

 private:
  PiecewiseCubic angles_;  // roll, pitch, yaw in radians; yaw without jumps
};

// The roll that is wanted at one moment, up to whole turns, and its weight (0: any roll will do).
struct DesiredRoll {
  double time_s = 0;
  double roll_rad = 0;
  double weight = 0;
};

// The roll at each desired roll's time: the function that departs least from the desired rolls and turns least, which
// is the minimum of
//   sum weight (roll - desired roll)^2 dt + tau^2 (d roll / dt)^2 dt.
// It follows a constant or linearly growing desired roll exactly, spreads a sudden change over about tau, and is
// linear where the weight is zero. Whole turns are chosen so that each desired roll is as near as possible to the last
// one before it that has a weight. Without any weight the roll is 0 throughout. Times strictly increasing. O(n).
[[nodiscard]] std::vector<double> smoothed_roll_rad(std::span<const DesiredRoll> desired_rolls, double tau_s = 0.15);

}  // namespace sigs
