// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "camera/example_lenses.h"

namespace sigs::test {
namespace {

// Evenly over a ball, a third of them on its skin.
glm::dvec3 somewhere_in_ball(std::mt19937& random) {
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform(0, 1);
  const glm::dvec3 direction = glm::normalize(glm::dvec3(normal(random), normal(random), normal(random)));
  const double share = uniform(random);
  return direction * (share < 1.0 / 3 ? 1.0 : std::cbrt(uniform(random)));
}

struct Worst {
  double of_bound = 0;  // largest share of its bound that an error reaches
  double error_px = 0;
  int with_image = 0;
  int without = 0;
};

// Holds a ball's image against what the lens makes of 60 of its points.
Worst worst_in(const Lens& lens, const glm::dvec3& center, double radius, const BallImage& ball, std::mt19937& random) {
  Worst worst;
  for (int i = 0; i < 60; ++i) {
    const glm::dvec3 p = center + radius * somewhere_in_ball(random);
    const auto pixel = lens.pixel(p);
    ++(pixel ? worst.with_image : worst.without);
    if (!pixel || !ball.all_have_image) continue;
    CHECK(glm::dot(ball.along, p) > 0);
    for (int axis = 0; axis < 2; ++axis) {
      const double linear = glm::dot(ball.across[static_cast<std::size_t>(axis)], p) / glm::dot(ball.along, p);
      const double error_px = std::abs((*pixel)[axis] - linear);
      worst.error_px = std::max(worst.error_px, error_px);
      worst.of_bound = std::max(worst.of_bound, error_px / ball.error_px);
    }
  }
  return worst;
}

}  // namespace

TEST_CASE("through every lens a ball's image bounds that of its points, and says rightly whether they have one") {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (const auto& [name, lens, size] : all_lenses()) {
    CAPTURE(name);
    int told = 0;
    int none = 0;
    for (int i = 0; i < 600; ++i) {
      const double angle_rad = std::min(1.3 * lens.valid_angle_rad(), std::numbers::pi) * uniform(random);
      const double distance = std::pow(10, 4 * uniform(random));
      const glm::dvec3 center = distance * direction(angle_rad, 2 * std::numbers::pi * uniform(random));
      const double radius = distance * std::pow(10, -4 * uniform(random));
      const BallImage ball = lens.ball_image(center, radius);
      CAPTURE(angle_rad);
      CAPTURE(radius / distance);
      const Worst worst = worst_in(lens, center, radius, ball, random);
      if (ball.none_has_image) CHECK(worst.with_image == 0);
      if (ball.all_have_image) CHECK(worst.without == 0);
      CHECK(worst.of_bound <= 1);
      CHECK_FALSE((ball.none_has_image && ball.all_have_image));
      told += ball.all_have_image;
      none += ball.none_has_image;
    }
    CHECK(told > 50);
    if (lens.valid_angle_rad() < 1.5) CHECK(none > 20);
  }
}

TEST_CASE("the bound of a small ball's image is not much more than its error") {
  std::mt19937 random(12);
  for (const auto& [name, lens, size] : all_lenses()) {
    if (lens.is_pinhole()) continue;
    CAPTURE(name);
    for (const double share : {0.2, 0.5, 0.7}) {
      CAPTURE(share);
      const glm::dvec3 center = 100.0 * direction(share * std::min(lens.valid_angle_rad(), 1.5), 0.7);
      const BallImage ball = lens.ball_image(center, 0.1);
      REQUIRE(ball.all_have_image);
      // A thousandth of a radian: of the image's 0.1 to 1 px a bend of order one takes some 1e-4 px.
      CHECK(ball.error_px < 0.02 * 1e-3 * lens.pixels_per_radian(center));
      CHECK(worst_in(lens, center, 0.1, ball, random).of_bound > 1e-4);
    }
  }
}

TEST_CASE("of a pinhole's image nothing but rounding is left over") {
  const Lens lens = lens_of(LensModel::brown_conrady, 535, 530, {342, 235}, {});
  const BallImage ball = lens.ball_image({100, 40, -30}, 20);
  REQUIRE(ball.all_have_image);
  CHECK(ball.error_px < 1e-8);
}

TEST_CASE("of a ball around the camera, or one without size or place, nothing wrong is said") {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  for (const auto& [name, lens, size] : example_lenses()) {
    CAPTURE(name);
    for (const double radius : {0.0, 1.0, 20.0, kInfinity, kNan}) {
      const BallImage around = lens.ball_image({0, 0, 0}, radius);
      CHECK_FALSE((around.all_have_image || around.none_has_image));
      const BallImage nowhere = lens.ball_image({kNan, 0, 0}, radius);
      CHECK_FALSE((nowhere.all_have_image || nowhere.none_has_image));
    }
    for (const double radius : {10.0, 20.0, kInfinity, kNan}) {
      const BallImage holding_us = lens.ball_image({10, 0, 0}, radius);
      CHECK_FALSE((holding_us.all_have_image || holding_us.none_has_image));
    }
    const BallImage point = lens.ball_image({10, 0.5, -0.2}, 0);
    REQUIRE(point.all_have_image);
    const auto pixel = lens.pixel({10, 0.5, -0.2});
    for (int axis = 0; axis < 2; ++axis)
      CHECK(std::abs(glm::dot(point.across[static_cast<std::size_t>(axis)], {10, 0.5, -0.2}) /
                         glm::dot(point.along, {10, 0.5, -0.2}) -
                     (*pixel)[axis]) <= point.error_px);
    CHECK(point.error_px < 1e-6);
  }
}

}  // namespace sigs::test
