// SPDX-License-Identifier: MIT
#pragma once

#include <glm/gtc/quaternion.hpp>
#include <span>

#include "spline/constant_speed.h"
#include "spline/trajectory.h"

namespace sigs {

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

}  // namespace sigs
