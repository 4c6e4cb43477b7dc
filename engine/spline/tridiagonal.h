// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "base/ensure.h"

namespace sigs {

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

}  // namespace sigs
