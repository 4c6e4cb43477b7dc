// SPDX-License-Identifier: MIT
#include "camera/numerics.h"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <numeric>

namespace sigs::distortion {
namespace {

// Where the sign of the polynomial changes between a and b, by bisection; the last number on the side of a.
double sign_change_between(const Polynomial& polynomial, double a, double b) {
  const bool positive_at_a = value_at(polynomial, a) > 0;
  for (;;) {
    const double middle = std::midpoint(a, b);
    if (middle == a || middle == b) return a;
    ((value_at(polynomial, middle) > 0) == positive_at_a ? a : b) = middle;
  }
}

// Ends of the intervals of (0, limit] on which the polynomial is monotonic, and limit itself.
std::vector<double> turning_points(const Polynomial& polynomial, double limit);

// All numbers in (0, limit] where the sign changes, ascending.
std::vector<double> sign_changes(const Polynomial& polynomial, double limit) {
  std::vector<double> changes;
  double from = 0;
  for (const double to : turning_points(polynomial, limit)) {
    if ((value_at(polynomial, from) > 0) != (value_at(polynomial, to) > 0))
      changes.push_back(sign_change_between(polynomial, from, to));
    from = to;
  }
  return changes;
}

std::vector<double> turning_points(const Polynomial& polynomial, double limit) {
  std::vector<double> points;
  if (polynomial.size() > 2) points = sign_changes(derivative(polynomial), limit);
  points.push_back(limit);
  return points;
}

}  // namespace

double value_at(const Polynomial& polynomial, double u) {
  return std::accumulate(polynomial.rbegin(), polynomial.rend(), 0.0,
                         [u](double sum_so_far, double c) { return sum_so_far * u + c; });
}

Polynomial derivative(const Polynomial& polynomial) {
  Polynomial result;
  for (std::size_t power = 1; power < polynomial.size(); ++power)
    result.push_back(polynomial[power] * static_cast<double>(power));
  return result;
}

Polynomial product(const Polynomial& a, const Polynomial& b) {
  if (a.empty() || b.empty()) return {};
  Polynomial result(a.size() + b.size() - 1, 0.0);
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t j = 0; j < b.size(); ++j) result[i + j] += a[i] * b[j];
  return result;
}

Polynomial sum(const Polynomial& a, const Polynomial& b, double b_factor) {
  Polynomial result(std::max(a.size(), b.size()), 0.0);
  for (std::size_t i = 0; i < a.size(); ++i) result[i] += a[i];
  for (std::size_t i = 0; i < b.size(); ++i) result[i] += b_factor * b[i];
  return result;
}

double first_fall(const Polynomial& polynomial, double limit) {
  const std::vector<double> changes = sign_changes(polynomial, limit);
  return changes.empty() ? std::numeric_limits<double>::infinity() : changes.front();
}

}  // namespace sigs::distortion
