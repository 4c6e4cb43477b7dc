// SPDX-License-Identifier: MIT
#include "spline/constant_speed.h"

#include <algorithm>
#include <utility>

namespace sigs {

namespace {

// Share of the mean speed below which rounding decides where the curve's velocity points.
constexpr double kStanding = 1e-9;
// Where to begin to look beside such a point, as a share of the whole time.
constexpr double kMin = 1e-7;

}  // namespace

ConstantSpeed::ConstantSpeed(PiecewiseCubic curve) : arc_length_(std::move(curve)) {
  if (arc_length_.total_m() > 0) speed_mps_ = arc_length_.total_m() / (last_s() - first_s());
}

// Where the curve itself stands: the direction in which it goes on, else the one in which it came. Looked for nearby,
// and farther away only where more than the velocity vanishes and the direction changes the less.
glm::dvec3 ConstantSpeed::tangent_beside(double parameter_s) const {
  for (double share = kMin; share < 1; share *= 10) {
    const double step_s = share * (last_s() - first_s());
    for (const double beside_s : {parameter_s + step_s, parameter_s - step_s}) {
      const glm::dvec3 velocity_mps = arc_length_.curve().motion_at(beside_s).velocity_mps;
      const double curve_mps = length(velocity_mps);
      if (curve_mps > kStanding * speed_mps_) return velocity_mps / curve_mps;
    }
  }
  return {0, 0, 0};
}

Motion ConstantSpeed::motion_at(double time_s) const {
  if (speed_mps_ == 0) return {.position_m = arc_length_.curve().motion_at(last_s()).position_m};
  const double inside_s = std::clamp(time_s, first_s(), last_s());
  const double arc_length_m = inside_s == last_s() ? arc_length_.total_m() : speed_mps_ * (inside_s - first_s());
  const double parameter_s = arc_length_.parameter_s_at(arc_length_m);
  const Motion on_curve = arc_length_.curve().motion_at(parameter_s);
  const double curve_mps = length(on_curve.velocity_mps);
  const bool standing = curve_mps <= kStanding * speed_mps_;

  const glm::dvec3 tangent = standing ? tangent_beside(parameter_s) : on_curve.velocity_mps / curve_mps;
  Motion motion{on_curve.position_m + (time_s - inside_s) * speed_mps_ * tangent, speed_mps_ * tangent, {0, 0, 0}};
  if (standing || inside_s != time_s) return motion;
  const glm::dvec3 across_mps2 = on_curve.acceleration_mps2 - dot(on_curve.acceleration_mps2, tangent) * tangent;
  const double pace = speed_mps_ / curve_mps;
  motion.acceleration_mps2 = pace * pace * across_mps2;
  return motion;
}

std::vector<double> ConstantSpeed::sample_times_s(int per_piece) const {
  std::vector<double> times_s = arc_length_.curve().sample_times_s(per_piece);
  if (speed_mps_ == 0) return times_s;
  for (double& time_s : times_s)
    time_s = std::min(first_s() + arc_length_.arc_length_m_at(time_s) / speed_mps_, last_s());
  return times_s;
}

}  // namespace sigs
