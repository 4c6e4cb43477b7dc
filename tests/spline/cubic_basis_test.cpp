// SPDX-License-Identifier: MIT

#include <doctest/doctest.h>
#include <cmath>

#include "spline/piecewise_cubic.h"

namespace sigs {

namespace {

// The recursion that defines B-splines (de Boor, A Practical Guide to Splines, chapter IX), with uniform knots.
double de_boor(double t, double first_knot, double h, int degree) {
  if (degree == 0) return t >= first_knot && t < first_knot + h ? 1 : 0;
  const double past_knot = first_knot + (degree + 1) * h;
  return (t - first_knot) / (degree * h) * de_boor(t, first_knot, h, degree - 1) +
         (past_knot - t) / (degree * h) * de_boor(t, first_knot + h, h, degree - 1);
}

}  // namespace

TEST_CASE("the cubic basis is what de Boor's recursion gives") {
  for (const double h : {0.04, 1.0, 250.0})
    for (double steps = -1.5; steps < 6; steps += 0.0625)
      CHECK(cubic_basis(7 + steps * h, 7, h) == doctest::Approx(de_boor(7 + steps * h, 7, h, 3)).epsilon(1e-11));
}

TEST_CASE("the cubic basis functions of neighbouring knots sum to one") {
  for (const double h : {0.04, 1.0, 250.0})
    for (double steps = 3; steps < 9; steps += 0.0625) {
      double sum = 0;
      for (int knot = 0; knot < 12; ++knot) sum += cubic_basis(steps * h, knot * h, h);
      CHECK(std::abs(sum - 1) < 1e-14);  // four numbers of size 1 added up
    }
}

TEST_CASE("the cubic basis is zero outside its four stretches and at their ends") {
  for (const double t : {-1e300, -1.0, 2.0, 6.0, 6.5, 1e300}) CHECK(cubic_basis(t, 2, 1) == 0);
  CHECK(cubic_basis(4, 2, 1) == doctest::Approx(2.0 / 3).epsilon(1e-15));  // 4 h^3 / (6 h^3) in the middle
}

}  // namespace sigs
