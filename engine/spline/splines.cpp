// SPDX-License-Identifier: MIT
#include "spline/splines.h"

#include <cmath>

#include "base/ensure.h"
#include "spline/piecewise_cubic.h"

namespace sigs {

double cubic_basis(double t, double first_knot, double h) {
  ENSURE(h > 0);
  const double steps = (t - first_knot) / h;
  if (!(steps > 0 && steps < 4)) return 0;
  const double knot = std::floor(steps);
  const double x = steps - knot;
  const auto& c = kCubicBasisPieces[static_cast<std::size_t>(knot)];
  return c[0] + x * (c[1] + x * (c[2] + x * c[3]));
}

namespace {

// The flight from one waypoint to the next.
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
  std::vector<TridiagonalRow<glm::dvec3>> rows(legs.size() + 1);  // a default row says: no acceleration
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

namespace {

constexpr std::size_t kPointsPerPiece = 4;  // number of control points that act on one piece

std::vector<glm::dvec3> control_points(std::span<const TimedWaypoint> waypoints) {
  std::vector<glm::dvec3> points_m;
  for (const TimedWaypoint& waypoint : waypoints) points_m.push_back(waypoint.position_m);
  if (points_m.size() >= kPointsPerPiece) return points_m;
  const std::size_t last = points_m.size() - 1;
  const glm::dvec3 before_m = 2.0 * points_m[0] - points_m[1];
  const glm::dvec3 after_m = 2.0 * points_m[last] - points_m[last - 1];
  points_m.insert(points_m.begin(), before_m);
  points_m.push_back(after_m);
  return points_m;
}

// Four successive control points make the piece: the oldest's basis function is on its last stretch, the newest's on
// its first. Summed as differences from one of the points, which is exact far from the origin since the basis sums
// to 1.
CubicPiece piece_of(std::span<const glm::dvec3, kPointsPerPiece> points_m, double duration_s) {
  CubicPiece piece{points_m[1]};
  double time_unit = 1;
  for (std::size_t power = 0; power < 4; ++power, time_unit *= duration_s)
    for (std::size_t i = 0; i < kPointsPerPiece; ++i)
      piece[power] += kCubicBasisPieces[3 - i][power] / time_unit * (points_m[i] - points_m[1]);
  return piece;
}

}  // namespace

PiecewiseCubic approximating_spline(std::span<const TimedWaypoint> waypoints) {
  ENSURE(!waypoints.empty());
  if (waypoints.size() == 1) return PiecewiseCubic({waypoints[0].time_s}, {}, waypoints[0].position_m);
  const std::vector<glm::dvec3> points_m = control_points(waypoints);
  const std::size_t count = points_m.size() - 3;
  const double first_s = waypoints.front().time_s;
  const double duration_s = (waypoints.back().time_s - first_s) / static_cast<double>(count);
  std::vector<double> knots_s;
  std::vector<CubicPiece> pieces;
  for (std::size_t i = 0; i < count; ++i) {
    knots_s.push_back(first_s + duration_s * static_cast<double>(i));
    pieces.push_back(piece_of(std::span(points_m).subspan(i).first<kPointsPerPiece>(), duration_s));
  }
  knots_s.push_back(waypoints.back().time_s);
  const CubicPiece& last = pieces.back();
  const glm::dvec3 end_m = last[0] + duration_s * (last[1] + duration_s * (last[2] + duration_s * last[3]));
  return PiecewiseCubic(std::move(knots_s), std::move(pieces), end_m);
}

}  // namespace sigs
