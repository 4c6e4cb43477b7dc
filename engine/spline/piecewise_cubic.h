// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "base/ensure.h"
#include "spline/trajectory.h"

namespace sigs {

// Position, velocity and acceleration at one moment, in the world.
struct Motion {
  glm::dvec3 position_m{0, 0, 0};
  glm::dvec3 velocity_mps{0, 0, 0};
  glm::dvec3 acceleration_mps2{0, 0, 0};
};

// One piece of a curve: X(s) = c[0] + c[1] s + c[2] s^2 + c[3] s^3 in metres, with s in seconds since the piece began.
using CubicPiece = std::array<glm::dvec3, 4>;

// A curve in the world that consists of cubic pieces, each over its own interval of time. Both kinds of spline
// (below) give one. Each piece counts its time and position from its own beginning, so that no digits are lost far
// from the origin. Before the first and after the last knot the curve goes on as a straight line.
class PiecewiseCubic {
 public:
  // knots_s: strictly increasing, one more than pieces. end_m: the point at the last knot. Without pieces the curve
  // stays there.
  PiecewiseCubic(std::vector<double> knots_s, std::vector<CubicPiece> pieces, const glm::dvec3& end_m);

  // O(log n). Acceleration at a knot is that of the piece that begins there; beyond the ends it is zero.
  [[nodiscard]] Motion motion_at(double time_s) const;

  [[nodiscard]] const std::vector<double>& knots_s() const { return knots_s_; }
  [[nodiscard]] double first_s() const { return knots_s_.front(); }
  [[nodiscard]] double last_s() const { return knots_s_.back(); }

  // Ascending times from the first knot to the last. They cut each piece into per_piece equal parts and also contain
  // each time at which the speed has a minimum or maximum. Between two neighbours the speed only rises or only falls,
  // so no moment of standing still is missed.
  [[nodiscard]] std::vector<double> sample_times_s(int per_piece) const;

 private:
  std::vector<double> knots_s_;
  std::vector<CubicPiece> pieces_;
  glm::dvec3 end_m_;
};

// The places in (0, 1) where c[0] + c[1] x + c[2] x^2 + c[3] x^3 changes its sign, ascending, exact to the last few
// bits. Leading coefficients may be zero. A double root, where the sign stays the same, may be left out.
[[nodiscard]] std::vector<double> sign_changes_in_unit_interval(const std::array<double, 4>& c);

// One row of a tridiagonal system of linear equations: before * x[i-1] + self * x[i] + after * x[i+1] = right.
// `before` of the first row and `after` of the last one are ignored. Value is a number or a vector.
template <class Value>
struct TridiagonalRow {
  double before = 0;
  double self = 1;
  double after = 0;
  Value right{};
};

// The solution x, by Thomas' algorithm, O(n). At least one row. There is no pivoting, so the rows must be diagonally
// dominant, as those of splines and of the roll's smoothing are.
template <class Value>
[[nodiscard]] std::vector<Value> solved(std::span<const TridiagonalRow<Value>> rows) {
  ENSURE(!rows.empty());
  std::vector<double> after(rows.size());
  std::vector<Value> x(rows.size());
  after[0] = rows[0].after / rows[0].self;
  x[0] = rows[0].right / rows[0].self;
  for (std::size_t i = 1; i < rows.size(); ++i) {
    const double pivot = rows[i].self - rows[i].before * after[i - 1];
    after[i] = rows[i].after / pivot;
    x[i] = (rows[i].right - rows[i].before * x[i - 1]) / pivot;
  }
  for (std::size_t i = rows.size() - 1; i-- > 0;) x[i] -= after[i] * x[i + 1];
  return x;
}

// The two kinds of spline through or near waypoints. Waypoints: at least one, times strictly increasing.

// The cubic spline through each waypoint at its time. Position, velocity and acceleration are continuous, and both ends
// are natural (no acceleration). Of all curves through the waypoints it has the smallest integral of the squared
// acceleration (Holladay 1957). One waypoint hovers; two give a straight line at one speed. O(n).
[[nodiscard]] PiecewiseCubic interpolating_spline(std::span<const TimedWaypoint> waypoints);

// The uniform cubic B-spline of the paper, equations (1) and (2): X(t) = sum of B_i,3(t) P_i for 3 <= t <= n + 1, where
// the n + 1 waypoints are the control points P_i and the knots are t = 0, 1, 2, ... The curve stays near the waypoints
// and inside their convex hull. In general it passes through none of them; it begins near the second one and ends near
// the last but one.
// Time: t = 3 at the first waypoint's time and t = n + 1 at the last one's, linear in between. The times of the other
// waypoints are not used.
// Equation (1) needs four waypoints. Two or three get reflected neighbours, 2 P_0 - P_1 before the first one and
// likewise after the last one, so that the curve begins and ends at the waypoints; two give the straight line. One
// hovers.
[[nodiscard]] PiecewiseCubic approximating_spline(std::span<const TimedWaypoint> waypoints);

// The basis of the uniform cubic B-spline, equation (2) of the paper, with the factor 1/(6 h^3), for which the basis
// functions sum to one. (With the printed factor 1/h their sum is 6 h^2.)

// The four polynomials of one basis function, from its first knot to its fifth. Row j contains the coefficients of 1,
// x, x^2, x^3 between knot j and knot j + 1, where x = (t - knot j) / h runs from 0 to 1.
inline constexpr std::array<std::array<double, 4>, 4> kCubicBasisPieces{{
    {0, 0, 0, 1.0 / 6},
    {1.0 / 6, 3.0 / 6, 3.0 / 6, -3.0 / 6},
    {4.0 / 6, 0, -6.0 / 6, 3.0 / 6},
    {1.0 / 6, -3.0 / 6, 3.0 / 6, -1.0 / 6},
}};

// Value at t of the basis function with the support [first_knot, first_knot + 4 h]; 0 outside it. h > 0.
[[nodiscard]] double cubic_basis(double t, double first_knot, double h);

}  // namespace sigs
