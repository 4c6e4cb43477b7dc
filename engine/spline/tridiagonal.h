// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "base/ensure.h"

namespace sigs {

// One row of a tridiagonal system: before * x[i-1] + self * x[i] + after * x[i+1] = right.
// The first row's `before` and the last row's `after` are not looked at.
template <class Value>
struct TridiagonalRow {
  double before = 0;
  double self = 1;
  double after = 0;
  Value right{};
};

// Thomas' algorithm, O(n). Without pivoting it is stable for diagonally dominant rows, which is all that this room has.
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
