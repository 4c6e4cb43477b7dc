// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <limits>
#include <numeric>
#include <optional>
#include <vector>

namespace sigs::distortion {

// Numerical tools of the lens models: polynomials, the inverse of an increasing function, and measures of vectors and
// matrices.

// Polynomial in one variable, coefficients in ascending order: c[0] + c[1] u + c[2] u^2 + ...
using Polynomial = std::vector<double>;

// The polynomial's value at u, by Horner's scheme. An empty polynomial is zero.
[[nodiscard]] double value_at(const Polynomial& polynomial, double u);

// The derivative by u; empty for constants.
[[nodiscard]] Polynomial derivative(const Polynomial& polynomial);

// a * b
[[nodiscard]] Polynomial product(const Polynomial& a, const Polynomial& b);

// a + b_factor * b
[[nodiscard]] Polynomial sum(const Polynomial& a, const Polynomial& b, double b_factor = 1);

// Smallest u in (0, limit] from which on the polynomial, positive at 0, is no longer positive; infinity where there is
// none. The result is exact to the last bits, however narrow the dip: between two roots of its derivative a polynomial
// is monotonic, so that bisection finds every change of sign.
[[nodiscard]] double first_fall(const Polynomial& polynomial, double limit);

// A function's value and its derivative at one place.
struct ValueAndSlope {
  double value = 0;
  double slope = 0;
};

// The x in [0, highest] at which an increasing function takes a value; nothing where the function does not reach it.
//   f  double -> ValueAndSlope, with f(0) = 0 and slope 1 there
// Newton's method. A step that leaves the bracket in which the answer is known to lie is replaced by bisection, so the
// search always ends.
template <class Function>
[[nodiscard]] std::optional<double> increasing_inverse(const Function& f, double value, double highest) {
  if (!(value >= 0 && value <= f(highest).value)) return std::nullopt;
  double low = 0;
  double high = highest;
  double x = std::min(value, highest);
  constexpr int kMaxSteps = 400;  // bisection of a bracket of any doubles takes fewer
  for (int step = 0; step < kMaxSteps; ++step) {
    const auto [y, slope] = f(x);
    if (y == value) return x;
    (y < value ? low : high) = x;
    double next = x - (y - value) / slope;
    if (!(next > low && next < high)) next = std::midpoint(low, high);
    if (std::abs(next - x) <= std::numeric_limits<double>::epsilon() * x) return next;
    x = next;
  }
  return x;
}

// Largest singular value of a 2x2 matrix: the most by which it stretches a vector. Closed form, from the eigenvalues of
// the transposed matrix times the matrix.
[[nodiscard]] inline double largest_singular_value(const glm::dmat2& m) {
  const double first = glm::dot(m[0], m[0]);
  const double second = glm::dot(m[1], m[1]);
  return std::sqrt((first + second + std::hypot(first - second, 2 * glm::dot(m[0], m[1]))) / 2);
}

// Angle between two vectors of any length, 0..pi, accurate for the smallest angles too. 0 where one of them is zero.
[[nodiscard]] inline double angle_between(const glm::dvec3& a, const glm::dvec3& b) {
  return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

}  // namespace sigs::distortion
