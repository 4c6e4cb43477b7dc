// SPDX-License-Identifier: MIT
#include "camera/lens.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "base/pose.h"
#include "camera/example_lenses.h"

namespace sigs::test {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInf = std::numeric_limits<double>::infinity();

// Two orders of the same sums in doubles: some 1e-13 of the pixel's size, and more where large terms cancel.
double rounding_px(const glm::dvec2& pixel) {
  return 1e-9 * std::max(1.0, glm::length(pixel) / 1000);
}

}  // namespace

TEST_CASE("every lens projects as OpenCV does over its whole field") {
  for (const ExampleLens& example : all_lenses()) {
    INFO(example.name);
    std::vector<glm::dvec3> directions = directions_over(example.lens, 80, 72, 0.999);
    std::erase_if(directions, [](const glm::dvec3& at) { return at.x < 0.02; });  // OpenCV's fisheye divides by depth
    CHECK(directions.size() > 2500);
    const std::vector<glm::dvec2> theirs = opencv_pixels(example.lens, directions);
    double worst = 0;
    for (std::size_t i = 0; i < directions.size(); ++i) {
      const auto pixel = example.lens.pixel(directions[i]);
      REQUIRE(pixel.has_value());
      worst = std::max(worst, glm::distance(*pixel, theirs[i]) / rounding_px(*pixel));
    }
    CHECK(worst < 1);
  }
}

TEST_CASE("the distance of a point does not change its pixel") {
  for (const ExampleLens& example : example_lenses()) {
    INFO(example.name);
    for (const glm::dvec3& at : directions_over(example.lens, 5, 7, 0.9)) {
      const auto near = example.lens.pixel(at * 1e-3);
      const auto far = example.lens.pixel(at * 1e7);
      REQUIRE(near.has_value());
      REQUIRE(far.has_value());
      CHECK(glm::distance(*near, *far) < rounding_px(*near));
    }
  }
}

TEST_CASE("the axis is projected to the principal point") {
  for (const ExampleLens& example : example_lenses()) {
    INFO(example.name);
    const LensParameters& l = example.lens.parameters();
    CHECK(example.lens.pixel({5, 0, 0}) == glm::dvec2{l.cx, l.cy});
    CHECK(example.lens.ray({l.cx, l.cy}) == glm::dvec3{1, 0, 0});
  }
}

TEST_CASE("right in the camera frame is right in the image and down is down") {
  const Lens lens = lens_of(LensModel::brown_conrady, 500, 400, {320, 240}, {});
  CHECK(lens.pixel({10, 1, 2}) == glm::dvec2{370, 320});
}

TEST_CASE("there is no pixel without a direction, and no ray without a pixel") {
  for (const ExampleLens& example : example_lenses()) {
    INFO(example.name);
    const Lens& lens = example.lens;
    for (const glm::dvec3& p :
         {glm::dvec3{0, 0, 0}, glm::dvec3{kNan, 0, 0}, glm::dvec3{1, kNan, 0}, glm::dvec3{1, 0, kNan},
          glm::dvec3{kInf, 0, 0}, glm::dvec3{1, kInf, 0}, glm::dvec3{1, 0, -kInf}, glm::dvec3{-1, 0, 0}}) {
      CHECK_FALSE(lens.pixel(p).has_value());
      CHECK(lens.pixels_per_radian(p) == 0);
    }
    for (const glm::dvec2& pixel :
         {glm::dvec2{kNan, 0}, glm::dvec2{0, kNan}, glm::dvec2{kInf, 0}, glm::dvec2{0, -kInf}})
      CHECK_FALSE(lens.ray(pixel).has_value());
  }
}

TEST_CASE("a Brown-Conrady lens has no image of points on or behind the camera's plane") {
  for (const ExampleLens& example : example_lenses()) {
    if (example.lens.parameters().model != LensModel::brown_conrady) continue;
    INFO(example.name);
    for (const double turn : {0.0, 1.0, 2.0, 3.0, 4.0, 5.0}) {
      CHECK_FALSE(example.lens.pixel(direction(rad_of_deg(90.001), turn)).has_value());
      CHECK_FALSE(example.lens.pixel(direction(rad_of_deg(150), turn)).has_value());
      CHECK_FALSE(example.lens.pixel(glm::dvec3{0, std::cos(turn), std::sin(turn)}).has_value());
    }
  }
}

TEST_CASE("a pinhole without distortion has an image of everything before it") {
  const Lens lens = lens_of(LensModel::brown_conrady, 500, 500, {320, 240}, {});
  CHECK(lens.is_pinhole());
  CHECK(lens.valid_angle_rad() == doctest::Approx(std::numbers::pi / 2).epsilon(1e-15));
  const auto pixel = lens.pixel({1e-3, 1e7, 0});
  REQUIRE(pixel.has_value());
  CHECK(pixel->x == doctest::Approx(5e12).epsilon(1e-9));  // 320 px beside 5e12
  const auto back = lens.ray(*pixel);
  REQUIRE(back.has_value());
  CHECK(angle_between(*back, {1e-3, 1e7, 0}) < 1e-15);  // a step of the pixel, 1e-3 px, is 2e-26 rad there
}

TEST_CASE("only lenses without distortion are pinholes") {
  for (const ExampleLens& example : example_lenses())
    CHECK_MESSAGE(example.lens.is_pinhole() == (example.name.find("pinhole") == 0), example.name);
}

TEST_CASE("a fisheye of 200 degrees has an image of what is behind the image plane") {
  const Lens lens = lens_of(LensModel::kannala_brandt, 260, 250, {480, 470}, {-0.01, 0.002, -0.0003, 0.00001});
  CHECK(deg_of_rad(lens.valid_angle_rad()) > 100);
  for (const double angle_deg : {80.0, 89.0, 90.0, 91.0, 100.0}) {
    const double t = rad_of_deg(angle_deg);
    const double distorted = t - 0.01 * std::pow(t, 3) + 0.002 * std::pow(t, 5) - 0.0003 * std::pow(t, 7) +
                             0.00001 * std::pow(t, 9);  // OpenCV's fisheye formula
    const double turn = 2.1;
    const auto pixel = lens.pixel(direction(t, turn) * 40.0);
    REQUIRE(pixel.has_value());
    CHECK(pixel->x == doctest::Approx(480 + 260 * distorted * std::cos(turn)).epsilon(1e-13));  // rounding
    CHECK(pixel->y == doctest::Approx(470 + 250 * distorted * std::sin(turn)).epsilon(1e-13));
    const auto back = lens.ray(*pixel);
    REQUIRE(back.has_value());
    CHECK(angle_between(*back, direction(t, turn)) < 1e-13);  // rounding
  }
}

TEST_CASE("magnification is how far the pixel moves when the direction turns") {
  for (const ExampleLens& example : all_lenses()) {
    INFO(example.name);
    for (const glm::dvec3& at : directions_over(example.lens, 8, 9, 0.95)) {
      const glm::dvec3 side =
          glm::normalize(glm::cross(at, std::abs(at.x) < 0.9 ? glm::dvec3{1, 0, 0} : glm::dvec3{0, 1, 0}));
      const glm::dvec3 other = glm::cross(at, side);
      constexpr double kTurn = 1e-6;
      double largest = 0;
      for (int i = 0; i < 360; ++i) {
        const double phi = i * std::numbers::pi / 360;
        const glm::dvec3 turn = kTurn * (std::cos(phi) * side + std::sin(phi) * other);
        const auto ahead = example.lens.pixel(at + turn);
        const auto back = example.lens.pixel(at - turn);
        REQUIRE(ahead.has_value());
        REQUIRE(back.has_value());
        largest = std::max(largest, glm::distance(*ahead, *back) / (2 * kTurn));
      }
      // 360 directions miss the largest by 1 - cos(0.25 deg) = 1e-5; near the poles and folds the third derivative
      // matters.
      CHECK(example.lens.pixels_per_radian(at * 3.0) == doctest::Approx(largest).epsilon(1e-4));
    }
  }
}

TEST_CASE("magnification of a pinhole has its closed form") {
  const Lens lens = lens_of(LensModel::brown_conrady, 500, 500, {320, 240}, {});
  CHECK(lens.pixels_per_radian({1, 0, 0}) == doctest::Approx(500).epsilon(1e-14));
  const double t = rad_of_deg(60);  // 1 / cos^2 = 4 along the radius
  CHECK(lens.pixels_per_radian(direction(t, 1)) == doctest::Approx(2000).epsilon(1e-13));
  CHECK(lens.pixels_per_radian({-1, 0, 0}) == 0);
}

TEST_CASE("invalid parameters are refused with a reason") {
  const auto reason = [](LensParameters parameters) {
    const auto lens = Lens::make(std::move(parameters));
    REQUIRE_FALSE(lens.has_value());
    CHECK(lens.error().where.empty());
    CHECK(lens.error().kind == ErrorKind::bad_data);
    return lens.error().what;
  };
  constexpr auto kBrownConrady = LensModel::brown_conrady;
  for (const std::size_t count : {1, 2, 3, 6, 7, 9, 10, 11, 13, 15})
    CHECK(reason({kBrownConrady, 1, 1, 0, 0, std::vector<double>(count)}) ==
          "expected 0, 4, 5, 8, 12 or 14 distortion coefficients, found " + std::to_string(count));
  for (const std::size_t count : {0, 3, 5})
    CHECK(reason({LensModel::kannala_brandt, 1, 1, 0, 0, std::vector<double>(count)}) ==
          "expected 4 fisheye coefficients, found " + std::to_string(count));
  for (const double bad : {0.0, -500.0}) {
    CHECK(reason({kBrownConrady, bad, 1, 0, 0, {}}) == "the focal length must be positive");
    CHECK(reason({kBrownConrady, 1, bad, 0, 0, {}}) == "the focal length must be positive");
  }
  for (const double bad : {kNan, kInf, -kInf}) {
    CHECK(reason({kBrownConrady, bad, 1, 0, 0, {}}) == "focal length and principal point must be finite");
    CHECK(reason({kBrownConrady, 1, 1, 0, bad, {}}) == "focal length and principal point must be finite");
    CHECK(reason({kBrownConrady, 1, 1, 0, 0, {0, bad, 0, 0}}) == "distortion coefficients must be finite");
  }
  std::vector<double> tilt(14);
  tilt[13] = 1.6;
  CHECK(reason({kBrownConrady, 1, 1, 0, 0, tilt}).find("tilt") != std::string::npos);
}

}  // namespace sigs::test
