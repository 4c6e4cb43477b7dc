// SPDX-License-Identifier: MIT
#include "accuracy/exact_spline.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "base/ensure.h"

namespace sigs::accuracy {

namespace {

constexpr std::ptrdiff_t kReach = 64;

std::size_t leg_of(std::span<const TimedWaypoint> waypoints, double time_s) {
  const auto after = std::upper_bound(waypoints.begin() + 1, waypoints.end() - 1, time_s,
                                      [](double value, const TimedWaypoint& w) { return value < w.time_s; });
  return static_cast<std::size_t>(after - waypoints.begin()) - 1;
}

std::vector<Real> legs_of(std::span<const TimedWaypoint> waypoints) {
  std::vector<Real> legs_s;
  for (std::size_t i = 0; i + 1 < waypoints.size(); ++i)
    legs_s.push_back(Real(waypoints[i + 1].time_s) - waypoints[i].time_s);
  return legs_s;
}

// 6 (change of mean velocity) at each inner waypoint, along one axis; 0 at the ends.
std::vector<Real> right_side(std::span<const TimedWaypoint> waypoints, std::span<const Real> legs_s, int axis) {
  std::vector<Real> right(waypoints.size(), 0);
  for (std::size_t i = 1; i + 1 < waypoints.size(); ++i) {
    const Real here = waypoints[i].position_m[axis];
    right[i] = 6 * ((waypoints[i + 1].position_m[axis] - here) / legs_s[i] -
                    (here - waypoints[i - 1].position_m[axis]) / legs_s[i - 1]);
  }
  return right;
}

}  // namespace

Dense spline_matrix(std::span<const Real> legs_s, Rows rows) {
  Dense matrix(legs_s.size() + 1);
  matrix.at(0, 0) = matrix.at(legs_s.size(), legs_s.size()) = rows == Rows::divided ? 2 : 1;
  for (std::size_t i = 1; i < legs_s.size(); ++i) {
    const Real both_s = legs_s[i - 1] + legs_s[i];
    const Real by = rows == Rows::divided ? both_s : 1;
    matrix.at(i, i - 1) = legs_s[i - 1] / by;
    matrix.at(i, i) = 2 * both_s / by;
    matrix.at(i, i + 1) = legs_s[i] / by;
  }
  return matrix;
}

ExactMotion exact_motion(std::span<const TimedWaypoint> all, double time_s) {
  ENSURE(all.size() >= 2);
  const auto leg_of_all = static_cast<std::ptrdiff_t>(leg_of(all, time_s));
  const std::ptrdiff_t first = std::max<std::ptrdiff_t>(0, leg_of_all - kReach);
  const std::ptrdiff_t end = std::min(std::ssize(all), leg_of_all + 2 + kReach);
  const auto near = all.subspan(static_cast<std::size_t>(first), static_cast<std::size_t>(end - first));
  const std::vector<Real> legs_s = legs_of(near);
  const auto i = static_cast<std::size_t>(leg_of_all - first);

  const std::vector<std::vector<Real>> a =
      solved_densely(spline_matrix(legs_s, Rows::textbook),
                     {right_side(near, legs_s, 0), right_side(near, legs_s, 1), right_side(near, legs_s, 2)});
  const Real h = legs_s[i];
  const Real s = Real(time_s) - near[i].time_s;
  ExactMotion motion;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto along = static_cast<int>(axis);
    const Real from = near[i].position_m[along];
    const Real to = near[i + 1].position_m[along];
    const Real c1 = (to - from) / h - h / 6 * (2 * a[axis][i] + a[axis][i + 1]);
    const Real c2 = a[axis][i] / 2;
    const Real c3 = (a[axis][i + 1] - a[axis][i]) / (6 * h);
    motion.position_m[along] = from + s * (c1 + s * (c2 + s * c3));
    motion.velocity_mps[along] = c1 + s * (2 * c2 + s * 3 * c3);
  }
  return motion;
}

namespace {

std::size_t pivot_row(const Dense& matrix, std::size_t column) {
  std::size_t best = column;
  for (std::size_t row = column + 1; row < matrix.size; ++row)
    if (std::fabs(matrix.at(row, column)) > std::fabs(matrix.at(best, column))) best = row;
  ENSURE(matrix.at(best, column) != 0);
  return best;
}

void swap_rows(Dense& matrix, std::vector<std::vector<Real>>& right_sides, std::size_t a, std::size_t b) {
  if (a == b) return;
  for (std::size_t column = 0; column < matrix.size; ++column) std::swap(matrix.at(a, column), matrix.at(b, column));
  for (std::vector<Real>& right : right_sides) std::swap(right[a], right[b]);
}

Real norm(const Dense& matrix) {
  Real largest = 0;
  for (std::size_t row = 0; row < matrix.size; ++row) {
    Real sum = 0;
    for (std::size_t column = 0; column < matrix.size; ++column) sum += std::fabs(matrix.at(row, column));
    largest = std::max(largest, sum);
  }
  return largest;
}

}  // namespace

std::vector<std::vector<Real>> solved_densely(Dense matrix, std::vector<std::vector<Real>> right_sides) {
  const std::size_t n = matrix.size;
  for (std::size_t i = 0; i < n; ++i) {
    swap_rows(matrix, right_sides, i, pivot_row(matrix, i));
    for (std::size_t row = i + 1; row < n; ++row) {
      const Real share = matrix.at(row, i) / matrix.at(i, i);
      if (share == 0) continue;
      for (std::size_t column = i; column < n; ++column) matrix.at(row, column) -= share * matrix.at(i, column);
      for (std::vector<Real>& right : right_sides) right[row] -= share * right[i];
    }
  }
  for (std::vector<Real>& right : right_sides)
    for (std::size_t i = n; i-- > 0;) {
      for (std::size_t column = i + 1; column < n; ++column) right[i] -= matrix.at(i, column) * right[column];
      right[i] /= matrix.at(i, i);
    }
  return right_sides;
}

Real condition_number(const Dense& matrix) {
  std::vector<std::vector<Real>> unit(matrix.size, std::vector<Real>(matrix.size, 0));
  for (std::size_t i = 0; i < matrix.size; ++i) unit[i][i] = 1;
  const std::vector<std::vector<Real>> columns = solved_densely(matrix, std::move(unit));
  Dense inverse(matrix.size);
  for (std::size_t column = 0; column < matrix.size; ++column)
    for (std::size_t row = 0; row < matrix.size; ++row) inverse.at(row, column) = columns[column][row];
  return norm(matrix) * norm(inverse);
}

}  // namespace sigs::accuracy
