// SPDX-License-Identifier: MIT
#include "accuracy/dense.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/ensure.h"

namespace sigs::accuracy {

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
