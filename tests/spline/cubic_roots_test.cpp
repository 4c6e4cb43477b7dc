// SPDX-License-Identifier: MIT

#include <doctest/doctest.h>
#include <cmath>

#include "spline/piecewise_cubic.h"

namespace sigs {

namespace {

std::array<double, 4> from_roots(double a, double b, double c, double factor) {
  return {-factor * a * b * c, factor * (a * b + b * c + c * a), -factor * (a + b + c), factor};
}

}  // namespace

TEST_CASE("the roots of a cubic between zero and one are found") {
  for (const double factor : {1e-12, 1.0, -3.0, 1e12}) {
    const auto all = sign_changes_in_unit_interval(from_roots(0.2, 0.5, 0.9, factor));
    REQUIRE(all.size() == 3);
    CHECK(std::abs(all[0] - 0.2) < 1e-13);  // rounding of the coefficients over the slope at the root
    CHECK(std::abs(all[1] - 0.5) < 1e-13);
    CHECK(std::abs(all[2] - 0.9) < 1e-13);
    CHECK(sign_changes_in_unit_interval(from_roots(-0.2, 0.5, 1.9, factor)).size() == 1);
    CHECK(sign_changes_in_unit_interval(from_roots(-0.2, 2, 3, factor)).empty());
  }
}

TEST_CASE("parabolas and lines and constants are cubics too") {
  const auto parabola = sign_changes_in_unit_interval({0.08, -0.6, 1, 0});  // (x - 0.2) (x - 0.4)
  REQUIRE(parabola.size() == 2);
  CHECK(std::abs(parabola[0] - 0.2) < 1e-14);
  CHECK(std::abs(parabola[1] - 0.4) < 1e-14);
  const auto line = sign_changes_in_unit_interval({-0.5, 2, 0, 0});
  REQUIRE(line.size() == 1);
  CHECK(std::abs(line[0] - 0.25) < 1e-15);
  CHECK(sign_changes_in_unit_interval({1, 0, 0, 0}).empty());
  CHECK(sign_changes_in_unit_interval({0, 0, 0, 0}).empty());
}

}  // namespace sigs
