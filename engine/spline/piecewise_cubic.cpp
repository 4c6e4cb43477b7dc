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

}  // namespace sigs
