// SPDX-License-Identifier: MIT
#include "spline/cubic_roots.h"

#include <algorithm>
#include <cmath>

namespace sigs {

namespace {

double value(const std::array<double, 4>& c, double x) {
  return ((c[3] * x + c[2]) * x + c[1]) * x + c[0];
}

// Where the cubic has no slope: the roots of c1 + 2 c2 x + 3 c3 x^2, in the form that cancels nothing.
std::vector<double> turning_points(const std::array<double, 4>& c) {
  const double discriminant = c[2] * c[2] - 3 * c[3] * c[1];
  if (discriminant < 0) return {};
  const double q = -(c[2] + std::copysign(std::sqrt(discriminant), c[2]));
  std::vector<double> points;
  if (c[3] != 0) points.push_back(q / (3 * c[3]));
  if (q != 0) points.push_back(c[1] / q);
  std::sort(points.begin(), points.end());
  return points;
}

// low and high lie on either side of one sign change.
double bisected(const std::array<double, 4>& c, double low, double high) {
  const bool low_is_negative = value(c, low) < 0;
  for (;;) {
    const double middle = low + (high - low) / 2;
    if (middle <= low || middle >= high) return middle;
    ((value(c, middle) < 0) == low_is_negative ? low : high) = middle;
  }
}

}  // namespace

std::vector<double> sign_changes_in_unit_interval(const std::array<double, 4>& c) {
  std::vector<double> edges{0};
  for (const double x : turning_points(c))
    if (x > edges.back() && x < 1) edges.push_back(x);
  edges.push_back(1);
  std::vector<double> roots;
  for (std::size_t i = 0; i + 1 < edges.size(); ++i)
    if ((value(c, edges[i]) < 0) != (value(c, edges[i + 1]) < 0)) roots.push_back(bisected(c, edges[i], edges[i + 1]));
  return roots;
}

}  // namespace sigs
