// SPDX-License-Identifier: MIT
#include "editor/geometry/image_drag.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "tests/editor/geometry/lenses.h"

namespace sigs::editor {
namespace {

using test::example_lenses;

const CameraPose kLevel{.rotation = {1, 0, 0, 0}, .translation_m = {0, 0, -150}};
const CameraPose kTurned{.rotation = rotation_of({0.2, -0.1, 2.2}), .translation_m = {1e5, -3e4, -900}};

// Pixels that each of the example lenses has a ray for.
const std::vector<glm::dvec2> kPixels{{640, 480}, {400, 300}, {900.25, 610.5}, {640, 200}, {850, 700}};

}  // namespace

TEST_CASE("straight ahead is the principal point, right is right and below is below") {
  for (const Camera& camera : example_lenses()) {
    const LensParameters& l = camera.lens.parameters();
    CHECK(glm::distance(*pixel_of({500, 0, -150}, kLevel, camera.lens), glm::dvec2(l.cx, l.cy)) < 1e-9);
    CHECK(pixel_of({500, 20, -150}, kLevel, camera.lens)->x > l.cx + 10);
    CHECK(pixel_of({500, 0, -130}, kLevel, camera.lens)->y > l.cy + 10);
  }
}

TEST_CASE("a point behind a pixel is at its distance and is seen in that pixel") {
  for (const Camera& camera : example_lenses())
    for (const CameraPose& pose : {kLevel, kTurned})
      for (const glm::dvec2& pixel : kPixels)
        for (const double distance_m : {0.5, 800.0, 1e7}) {
          const auto point = point_behind(pixel, distance_m, pose, camera.lens);
          REQUIRE(point.has_value());
          CHECK(glm::distance(*point, pose.translation_m) == doctest::Approx(distance_m).epsilon(1e-9));
          // Half a metre off a camera 100 km from the origin, the digits of a double are worth 1e-8 px.
          CHECK(glm::distance(*pixel_of(*point, pose, camera.lens), pixel) < 1e-6);
        }
}

TEST_CASE("no distance and no ray give no point") {
  const auto lenses = example_lenses();
  for (const double distance_m : {0.0, -5.0, std::numeric_limits<double>::infinity(), std::nan("")})
    CHECK_FALSE(point_behind({640, 480}, distance_m, kLevel, lenses[0].lens).has_value());
  CHECK_FALSE(point_behind({std::nan(""), 480}, 10, kLevel, lenses[0].lens).has_value());
  CHECK_FALSE(point_behind({1e6, 1e6}, 10, kLevel, lenses[0].lens).has_value());
}

TEST_CASE("a point dragged across the footage follows the mouse at its distance, and keeps its grip") {
  for (const Camera& camera : example_lenses())
    for (const CameraPose& pose : {kLevel, kTurned})
      for (const double distance_m : {30.0, 1e7}) {
        const glm::dvec3 start_m = *point_behind({500, 400}, distance_m, pose, camera.lens);
        const glm::dvec2 taken_at{503, 398};
        for (const glm::dvec2& to : kPixels) {
          const auto end_m = dragged_across(start_m, taken_at, to, pose, camera.lens);
          REQUIRE(end_m.has_value());
          const glm::dvec2 expected = to + glm::dvec2{500, 400} - taken_at;
          CHECK(glm::distance(*pixel_of(*end_m, pose, camera.lens), expected) < 1e-6);
          CHECK(glm::distance(*end_m, pose.translation_m) == doctest::Approx(distance_m).epsilon(1e-9));
        }
      }
}

TEST_CASE("there and back again is the same point, through each lens") {
  for (const Camera& camera : example_lenses())
    for (const CameraPose& pose : {kLevel, kTurned})
      for (const double distance_m : {1.0, 30.0, 1e7}) {
        const glm::dvec3 start_m = *point_behind({500, 400}, distance_m, pose, camera.lens);
        glm::dvec3 p_m = start_m;
        glm::dvec2 at{503, 398};
        for (const glm::dvec2& to : {kPixels[1], kPixels[2], kPixels[4], glm::dvec2{503, 398}}) {
          p_m = dragged_across(p_m, at, to, pose, camera.lens).value();
          at = to;
        }
        CHECK(glm::distance(p_m, start_m) < 1e-6 * distance_m);
      }
}

TEST_CASE("a point without an image, or a pixel without a ray, is not dragged") {
  for (const Camera& camera : example_lenses()) {
    const glm::dvec3 behind{-500, 0, -150};
    CHECK_FALSE(dragged_across(behind, {640, 480}, {600, 480}, kLevel, camera.lens).has_value());
    const glm::dvec3 ahead{500, 0, -150};
    CHECK_FALSE(dragged_across(ahead, {640, 480}, {std::nan(""), 480}, kLevel, camera.lens).has_value());
    CHECK(dragged_across(ahead, {640, 480}, {640, 480}, kLevel, camera.lens) == ahead);
  }
  CHECK_FALSE(dragged_across({500, 0, -150}, {640, 480}, {1e5, 480}, kLevel, example_lenses()[0].lens).has_value());
}

TEST_CASE("a hundred pixels up double the distance and a hundred down halve it, in the same pixel") {
  const glm::dvec3 start_m = kTurned * glm::dvec3{400, 30, -20};
  const glm::dvec3 from_camera = start_m - kTurned.translation_m;
  for (const double up_px : {100.0, -100.0, 37.0, 250.0, 0.0}) {
    const glm::dvec3 end_m = dragged_along(start_m, up_px, kTurned);
    const glm::dvec3 expected = kTurned.translation_m + from_camera * std::pow(2, up_px / 100);
    CHECK(glm::distance(end_m, expected) < 1e-9 * glm::length(expected));
  }
}

TEST_CASE("a drag along the ray ends a tenth of a metre and 1e8 m away") {
  const glm::dvec3 start_m{400, 0, -150};
  CHECK(glm::distance(dragged_along(start_m, -1e6, kLevel), kLevel.translation_m) == doctest::Approx(0.1));
  CHECK(glm::distance(dragged_along(start_m, 1e6, kLevel), kLevel.translation_m) == doctest::Approx(1e8));
  CHECK(dragged_along(start_m, std::nan(""), kLevel) == start_m);
}

TEST_CASE("a point at the camera itself leaves along the optical axis") {
  const glm::dvec3 end_m = dragged_along(kLevel.translation_m, 100, kLevel);
  CHECK(glm::distance(end_m, glm::dvec3{0.2, 0, -150}) < 1e-12);
}

}  // namespace sigs::editor
