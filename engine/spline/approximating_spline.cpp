// SPDX-License-Identifier: MIT
#include "spline/approximating_spline.h"

#include "base/ensure.h"
#include "spline/cubic_basis.h"

namespace sigs {

namespace {

constexpr std::size_t kMin = 4;  // control points that act on one piece

std::vector<glm::dvec3> control_points(std::span<const TimedWaypoint> waypoints) {
  std::vector<glm::dvec3> points_m;
  for (const TimedWaypoint& waypoint : waypoints) points_m.push_back(waypoint.position_m);
  if (points_m.size() >= kMin) return points_m;
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
CubicPiece piece_of(std::span<const glm::dvec3, kMin> points_m, double duration_s) {
  CubicPiece piece{points_m[1]};
  double time_unit = 1;
  for (std::size_t power = 0; power < 4; ++power, time_unit *= duration_s)
    for (std::size_t i = 0; i < kMin; ++i)
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
    pieces.push_back(piece_of(std::span(points_m).subspan(i).first<kMin>(), duration_s));
  }
  knots_s.push_back(waypoints.back().time_s);
  const CubicPiece& last = pieces.back();
  const glm::dvec3 end_m = last[0] + duration_s * (last[1] + duration_s * (last[2] + duration_s * last[3]));
  return PiecewiseCubic(std::move(knots_s), std::move(pieces), end_m);
}

}  // namespace sigs
