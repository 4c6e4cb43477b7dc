// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "accuracy/angle.h"
#include "spline/trajectory.h"

namespace sigs::accuracy {

// A full matrix, row by row.
struct Dense {
  explicit Dense(std::size_t side) : size(side), values(side * side, Real(0)) {}

  [[nodiscard]] Real& at(std::size_t row, std::size_t column) { return values[row * size + column]; }
  [[nodiscard]] Real at(std::size_t row, std::size_t column) const { return values[row * size + column]; }

  std::size_t size;
  std::vector<Real> values;
};

// x of matrix * x = right for each right side: Gauss with row pivoting. The matrix must not be singular.
[[nodiscard]] std::vector<std::vector<Real>> solved_densely(Dense matrix, std::vector<std::vector<Real>> right_sides);

// Largest sum of a row's magnitudes, of the matrix times that of its inverse.
[[nodiscard]] Real condition_number(const Dense& matrix);

struct ExactMotion {
  Real3 position_m{0, 0, 0};
  Real3 velocity_mps{0, 0, 0};
};

// The natural cubic spline through the waypoints at a time within them, in long double, by a full matrix over the 64
// waypoints to either side: what a waypoint farther off changes is less than 2^-64 of what it is away, as influence
// halves at least from row to row (each row's middle is twice the sum of its neighbours).
[[nodiscard]] ExactMotion exact_motion(std::span<const TimedWaypoint> waypoints, double time_s);

// How the rows are written: as the formula of textbooks has them, or divided by h + k as engine/spline has them.
enum class Rows { textbook, divided };

// The matrix of the spline's accelerations for legs of these durations, natural ends.
[[nodiscard]] Dense spline_matrix(std::span<const Real> legs_s, Rows rows);

}  // namespace sigs::accuracy
