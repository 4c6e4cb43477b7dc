// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "accuracy/angle.h"

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

}  // namespace sigs::accuracy
