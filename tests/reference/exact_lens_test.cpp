// SPDX-License-Identifier: MIT
#include "reference/exact_lens.h"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "camera/example_lenses.h"

namespace sigs::truth {
namespace {

using LongVec2 = ExactLens<long double>::Vec2;

double apart(const glm::dvec2& a, const glm::dvec2& b) {
  return std::hypot(a.x - b.x, a.y - b.y);
}

// In front of the camera, where OpenCV's pinhole models are valid, and short of the rim.
std::vector<glm::dvec3> directions_before(const Lens& lens) {
  std::vector<glm::dvec3> directions;
  for (const glm::dvec3& d : test::directions_over(lens, 8, 12, 0.98))
    if (d.x > 0.05) directions.push_back(d);
  return directions;
}

}  // namespace

TEST_CASE("the exact lens projects points where OpenCV does") {
  for (const test::ExampleLens& example : test::example_lenses()) {
    CAPTURE(example.name);
    const ExactLens<double> exact(example.lens.parameters());
    const std::vector<glm::dvec3> directions = directions_before(example.lens);
    const std::vector<glm::dvec2> pixels = test::opencv_pixels(example.lens, directions);
    for (std::size_t i = 0; i < directions.size(); ++i) {
      CAPTURE(directions[i]);
      const auto pixel = exact.pixel(directions[i]);
      REQUIRE(pixel.has_value());
      // Both count in doubles; a rational lens near its pole loses some of their digits.
      CHECK(apart(*pixel, pixels[i]) < 1e-11 * (1e3 + glm::length(pixels[i])));
    }
  }
}

TEST_CASE("the exact lens' inverse in long double is projected back to within 1e-12 px") {
  for (const test::ExampleLens& example : test::example_lenses()) {
    CAPTURE(example.name);
    const ExactLens<long double> exact(example.lens.parameters());
    int found = 0;
    for (const glm::dvec3& direction : directions_before(example.lens)) {
      const auto pixel = exact.pixel(direction);
      REQUIRE(pixel.has_value());
      CAPTURE(direction);
      const auto ray = exact.ray(*pixel);
      REQUIRE(ray.has_value());
      const auto back = exact.pixel(*ray);
      REQUIRE(back.has_value());
      CHECK(std::hypot(back->x - pixel->x, back->y - pixel->y) <= 1e-15L * (1e3L + glm::length(*pixel)));
      ++found;
    }
    CHECK(found > 30);
  }
}

TEST_CASE("the exact lens' field ends at the fold that the engine finds by another method") {
  for (const test::ExampleLens& example : test::example_lenses()) {
    CAPTURE(example.name);
    const ExactLens<double> exact(example.lens.parameters());
    // Steps of 90 / 3000 degrees may pass over a gap smaller than that, and leave that much at the end.
    CHECK(exact.field_angle_rad() == doctest::Approx(example.lens.valid_angle_rad()).epsilon(6e-4));
  }
}

TEST_CASE("beyond its field the exact lens has neither pixels nor rays") {
  const test::ExampleLens folding{
      "folds",
      test::lens_of(LensModel::brown_conrady, 233.6, 233.6, {320, 240}, {-0.32744, 0.12814, 0, 0, -0.023876}),
      {640, 480}};
  const ExactLens<double> exact(folding.lens.parameters());
  const double edge_rad = exact.field_angle_rad();
  CHECK(exact.pixel(test::direction(0.999 * edge_rad, 0.3)).has_value());
  CHECK_FALSE(exact.pixel(test::direction(1.001 * edge_rad, 0.3)).has_value());
  CHECK_FALSE(exact.pixel({-1, 0, 0}).has_value());
  CHECK_FALSE(exact.pixel({0, 0, 0}).has_value());
  CHECK_FALSE(exact.pixel({std::nan(""), 0, 0}).has_value());
  const auto rim = exact.pixel(test::direction(0.9999 * edge_rad, 0));
  REQUIRE(rim.has_value());
  CHECK(exact.ray({rim->x - 1, rim->y}).has_value());
  CHECK_FALSE(exact.ray({rim->x + 1, rim->y}).has_value());
}

}  // namespace sigs::truth
