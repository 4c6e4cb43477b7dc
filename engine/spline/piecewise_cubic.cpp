// SPDX-License-Identifier: MIT
#include "spline/piecewise_cubic.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/ensure.h"

namespace sigs {

namespace {

double value(const std::array<double, 4>& c, double x) {
  return ((c[3] * x + c[2]) * x + c[1]) * x + c[0];
}

// Where the cubic has no slope: the roots of c1 + 2 c2 x + 3 c3 x^2, in the form that cancels nothing.
std::vector<double> turning_points(const std::array<double, 4>& c) {
  const double discriminant = c[2] * c[2] - 3 * c[3] * c[1];
  if (discriminant < 0) return {};
  const double q = -(c[2] + std::copysign(std::sqrt(discriminant), c[2]));
  std::vector<double> points;
  if (c[3] != 0) points.push_back(q / (3 * c[3]));
  if (q != 0) points.push_back(c[1] / q);
  std::sort(points.begin(), points.end());
  return points;
}

// low and high lie on either side of one sign change.
double bisected(const std::array<double, 4>& c, double low, double high) {
  const bool low_is_negative = value(c, low) < 0;
  for (;;) {
    const double middle = low + (high - low) / 2;
    if (middle <= low || middle >= high) return middle;
    ((value(c, middle) < 0) == low_is_negative ? low : high) = middle;
  }
}

}  // namespace

std::vector<double> sign_changes_in_unit_interval(const std::array<double, 4>& c) {
  std::vector<double> edges{0};
  for (const double x : turning_points(c))
    if (x > edges.back() && x < 1) edges.push_back(x);
  edges.push_back(1);
  std::vector<double> roots;
  for (std::size_t i = 0; i + 1 < edges.size(); ++i)
    if ((value(c, edges[i]) < 0) != (value(c, edges[i + 1]) < 0)) roots.push_back(bisected(c, edges[i], edges[i + 1]));
  return roots;
}

namespace {

Motion motion_of(const CubicPiece& c, double s) {
  return {.position_m = c[0] + s * (c[1] + s * (c[2] + s * c[3])),
          .velocity_mps = c[1] + s * (2.0 * c[2] + 3.0 * s * c[3]),
          .acceleration_mps2 = 2.0 * c[2] + 6.0 * s * c[3]};
}

// Shares of the piece at which the square of its speed has no slope: velocity * acceleration = 0.
std::vector<double> shares_of_extreme_speed(const CubicPiece& c, double duration_s) {
  const glm::dvec3 v0 = c[1];
  const glm::dvec3 v1 = 2.0 * duration_s * c[2];
  const glm::dvec3 v2 = 3.0 * duration_s * duration_s * c[3];
  return sign_changes_in_unit_interval({dot(v0, v1), 2 * dot(v0, v2) + dot(v1, v1), 3 * dot(v1, v2), 2 * dot(v2, v2)});
}

}  // namespace

PiecewiseCubic::PiecewiseCubic(std::vector<double> knots_s, std::vector<CubicPiece> pieces, const glm::dvec3& end_m)
    : knots_s_(std::move(knots_s)), pieces_(std::move(pieces)), end_m_(end_m) {
  ENSURE(knots_s_.size() == pieces_.size() + 1);
}

Motion PiecewiseCubic::motion_at(double time_s) const {
  if (pieces_.empty()) return {.position_m = end_m_};
  const double inside_s = std::clamp(time_s, first_s(), last_s());
  const auto next_knot = std::upper_bound(knots_s_.begin() + 1, knots_s_.end() - 1, inside_s);
  const auto piece = static_cast<std::size_t>(next_knot - knots_s_.begin() - 1);
  Motion motion = motion_of(pieces_[piece], inside_s - knots_s_[piece]);
  if (inside_s == last_s()) motion.position_m = end_m_;  // the polynomial's rounding would show in the last bits
  if (inside_s == time_s) return motion;
  motion.position_m += (time_s - inside_s) * motion.velocity_mps;
  motion.acceleration_mps2 = {0, 0, 0};
  return motion;
}

std::vector<double> PiecewiseCubic::sample_times_s(int per_piece) const {
  std::vector<double> times_s;
  for (std::size_t i = 0; i < pieces_.size(); ++i) {
    const double duration_s = knots_s_[i + 1] - knots_s_[i];
    const auto begin = static_cast<std::ptrdiff_t>(times_s.size());
    for (int part = 0; part < per_piece; ++part) times_s.push_back(knots_s_[i] + duration_s * part / per_piece);
    for (const double share : shares_of_extreme_speed(pieces_[i], duration_s))
      times_s.push_back(knots_s_[i] + duration_s * share);
    std::sort(times_s.begin() + begin, times_s.end());
  }
  times_s.push_back(last_s());
  return times_s;
}

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
