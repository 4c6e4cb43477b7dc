// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <variant>
#include <vector>

#include "camera/distortion_models.h"
#include "camera/example_lenses.h"

namespace sigs::test {
namespace {

using distortion::BrownConrady;
using distortion::Polynomial;

template <class Model>
void check_jacobian(const Model& model, double largest_radius) {
  for (int ring = 0; ring <= 10; ++ring)
    for (int spoke = 0; spoke < 12; ++spoke) {
      const glm::dvec2 p = largest_radius * ring / 10 * glm::dvec2{std::cos(spoke * 0.5), std::sin(spoke * 0.5)};
      const glm::dmat2 jacobian = model.jacobian(p);
      for (int axis = 0; axis < 2; ++axis) {
        constexpr double kStep = 1e-5;
        glm::dvec2 step{0, 0};
        step[axis] = kStep;
        // Fourth order, so the remainder is 1e-20 times a fifth derivative, and rounding 1e-16 / 1e-5.
        const glm::dvec2 difference = (8.0 * (model.distorted(p + step) - model.distorted(p - step)) -
                                       (model.distorted(p + 2.0 * step) - model.distorted(p - 2.0 * step))) /
                                      (12 * kStep);
        CHECK(glm::distance(jacobian[axis], difference) < 1e-8 * (1 + glm::length(difference)));
      }
    }
}

}  // namespace

TEST_CASE("the Jacobian of every lens is that of finite differences") {
  for (const ExampleLens& example : all_lenses()) {
    INFO(example.name);
    const LensParameters& l = example.lens.parameters();
    std::visit(
        [](const auto& model) {
          constexpr double kFar = 3.2;  // beyond it differences lose their digits, and no image reaches
          const double radius = 0.99 * distortion::valid_field(model).radius;
          check_jacobian(model, radius < kFar ? radius : 1.2);
        },
        distortion::model_of(l.model, l.coefficients));
  }
}

TEST_CASE("the inverse of the tilt leads back to the point") {
  std::vector<double> coefficients(14, 0.0);
  coefficients[12] = 0.3;
  coefficients[13] = -0.2;
  const BrownConrady model = BrownConrady::of(coefficients);
  for (const double x : {-0.7, 0.0, 0.4})
    for (const double y : {-0.5, 0.0, 0.6}) {
      const auto back = model.untilted(model.distorted({x, y}));
      REQUIRE(back.has_value());
      CHECK(glm::distance(*back, {x, y}) < 1e-14);  // rounding
    }
}

TEST_CASE("points beyond the horizon of a tilted sensor have no inverse") {
  std::vector<double> coefficients(14, 0.0);
  coefficients[12] = 0.3;
  const BrownConrady model = BrownConrady::of(coefficients);
  // A point whose plane coordinates go through infinity: y of the plane grows without limit towards the horizon.
  const double near_horizon = model.distorted({0, -1e9}).y;
  const double step = near_horizon > 0 ? 1e-3 : -1e-3;
  CHECK(model.untilted({0, near_horizon - step}).has_value());
  CHECK_FALSE(model.untilted({0, near_horizon + step}).has_value());
}

TEST_CASE("first_fall gives a polynomial's smallest positive root") {
  // (u - 0.5) (u - 2) (u - 3), made positive at 0
  CHECK(distortion::first_fall(Polynomial{3, -8.5, 5.5, -1}, 1e16) == doctest::Approx(0.5).epsilon(1e-14));
  CHECK(distortion::first_fall(Polynomial{1, 0, 1}, 1e16) == std::numeric_limits<double>::infinity());
  CHECK(distortion::first_fall(Polynomial{1}, 1e16) == std::numeric_limits<double>::infinity());
  CHECK(distortion::first_fall(Polynomial{1, -1e-12}, 1e16) == doctest::Approx(1e12).epsilon(1e-14));
  CHECK(distortion::first_fall(Polynomial{1, -1e-12}, 1e11) == std::numeric_limits<double>::infinity());
}

TEST_CASE("two roots a few millionths apart are found") {
  // (u - 1)^2 = 1e-12, so the roots are 1 - 1e-6 and 1 + 1e-6; a double root doubles the digits that rounding takes
  const Polynomial dip{1 - 1e-12, -2, 1};
  CHECK(distortion::first_fall(dip, 1e16) == doctest::Approx(1 - 1e-6).epsilon(1e-9));
}

TEST_CASE("sums and products of polynomials are those of their values") {
  const Polynomial a{1, -2, 3};
  const Polynomial b{0.5, 4};
  for (const double u : {-1.5, 0.0, 0.3, 2.0}) {
    const double at = distortion::value_at(a, u);
    const double bt = distortion::value_at(b, u);
    CHECK(distortion::value_at(distortion::product(a, b), u) == doctest::Approx(at * bt).epsilon(1e-14));
    CHECK(distortion::value_at(distortion::sum(a, b, -2), u) == doctest::Approx(at - 2 * bt).epsilon(1e-14));
    CHECK(distortion::value_at(distortion::derivative(a), u) == doctest::Approx(-2 + 6 * u).epsilon(1e-14));
  }
}

}  // namespace sigs::test
