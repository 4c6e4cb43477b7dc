// SPDX-License-Identifier: MIT
#include "spline/interpolating_spline.h"

#include "base/ensure.h"
#include "spline/tridiagonal.h"

namespace sigs {

namespace {

// From one waypoint to the next.
struct Leg {
  double duration_s;
  glm::dvec3 mean_velocity_mps;
};

std::vector<Leg> legs_between(std::span<const TimedWaypoint> waypoints) {
  std::vector<Leg> legs;
  legs.reserve(waypoints.size());
  for (std::size_t i = 0; i + 1 < waypoints.size(); ++i) {
    const double duration_s = waypoints[i + 1].time_s - waypoints[i].time_s;
    legs.push_back({duration_s, (waypoints[i + 1].position_m - waypoints[i].position_m) / duration_s});
  }
  return legs;
}

// Velocity is continuous at every inner waypoint: h a[i-1] + 2 (h + k) a[i] + k a[i+1] = 6 (change of mean velocity),
// where h and k are the durations before and after. Divided by h + k, legs of any durations make rows of one size.
std::vector<glm::dvec3> accelerations_at_waypoints(std::span<const Leg> legs) {
  std::vector<TridiagonalRow<glm::dvec3>> rows(legs.size() + 1);  // as they stand, they say: no acceleration
  for (std::size_t i = 1; i < legs.size(); ++i) {
    const double both_s = legs[i - 1].duration_s + legs[i].duration_s;
    rows[i] = {.before = legs[i - 1].duration_s / both_s,
               .self = 2,
               .after = legs[i].duration_s / both_s,
               .right = 6.0 * (legs[i].mean_velocity_mps - legs[i - 1].mean_velocity_mps) / both_s};
  }
  return solved<glm::dvec3>(rows);
}

// Acceleration runs linearly from one end of the leg to the other.
CubicPiece piece_of(const Leg& leg, const glm::dvec3& from_m, const glm::dvec3& from_mps2, const glm::dvec3& to_mps2) {
  return {from_m, leg.mean_velocity_mps - leg.duration_s / 6 * (2.0 * from_mps2 + to_mps2), from_mps2 / 2.0,
          (to_mps2 - from_mps2) / (6 * leg.duration_s)};
}

}  // namespace

PiecewiseCubic interpolating_spline(std::span<const TimedWaypoint> waypoints) {
  ENSURE(!waypoints.empty());
  const std::vector<Leg> legs = legs_between(waypoints);
  const std::vector<glm::dvec3> a_mps2 = accelerations_at_waypoints(legs);
  std::vector<double> knots_s;
  for (const TimedWaypoint& waypoint : waypoints) knots_s.push_back(waypoint.time_s);
  std::vector<CubicPiece> pieces;
  for (std::size_t i = 0; i < legs.size(); ++i)
    pieces.push_back(piece_of(legs[i], waypoints[i].position_m, a_mps2[i], a_mps2[i + 1]));
  return PiecewiseCubic(std::move(knots_s), std::move(pieces), waypoints.back().position_m);
}

}  // namespace sigs
