// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>

namespace sigs::truth {

// A number with its slopes by two variables (forward automatic differentiation, Wengert 1964).
template <class Real>
struct Dual {
  Real value = 0;
  Real by_x = 0;
  Real by_y = 0;

  friend Dual operator+(const Dual& a, const Dual& b) { return {a.value + b.value, a.by_x + b.by_x, a.by_y + b.by_y}; }
  friend Dual operator-(const Dual& a, const Dual& b) { return {a.value - b.value, a.by_x - b.by_x, a.by_y - b.by_y}; }
  friend Dual operator*(const Dual& a, const Dual& b) {
    return {a.value * b.value, a.by_x * b.value + a.value * b.by_x, a.by_y * b.value + a.value * b.by_y};
  }
  friend Dual operator/(const Dual& a, const Dual& b) {
    const Real q = a.value / b.value;
    return {q, (a.by_x - q * b.by_x) / b.value, (a.by_y - q * b.by_y) / b.value};
  }
  friend Dual operator*(Real a, const Dual& b) { return {a * b.value, a * b.by_x, a * b.by_y}; }
  friend Dual operator+(Real a, const Dual& b) { return {a + b.value, b.by_x, b.by_y}; }

  // Of a number above zero.
  friend Dual sqrt(const Dual& a) {
    const Real root = std::sqrt(a.value);
    return {root, a.by_x / (2 * root), a.by_y / (2 * root)};
  }
};

}  // namespace sigs::truth
