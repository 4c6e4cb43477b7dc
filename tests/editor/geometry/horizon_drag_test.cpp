// SPDX-License-Identifier: MIT
#include "editor/geometry/horizon_drag.h"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "tests/editor/geometry/lenses.h"

namespace sigs::editor {
namespace {

using test::example_lenses;

constexpr double kRounding = 1e-9;
const glm::dvec2 kSize{1280, 960};

Lens pinhole(double focal_px, const glm::dvec2& center_px) {
  return Lens::make({.fx = focal_px, .fy = focal_px, .cx = center_px.x, .cy = center_px.y}).value();
}

// How far a pixel's ray lies from the level, as sine of its elevation, by the rotation that the engine uses.
double slope_at(const glm::dvec2& pixel, const HorizonTilt& tilt, const Lens& lens) {
  return (rotation_of({tilt.roll_rad, tilt.pitch_rad, 0.7}) * lens.ray(pixel).value()).z;
}

}  // namespace

TEST_CASE("before a pinhole, the horizon lifted by dy gives the pitch atan(dy / f)") {
  const Lens lens = pinhole(800, {639.5, 479.5});
  for (const double down_px : {-400.0, -1.0, 0.0, 37.5, 2000.0}) {
    // Without roll it is the same across the image.
    for (const double x : {0.0, 639.5, 1100.0}) {
      const auto tilt = lifted_to({x, 479.5 + down_px}, 0, lens);
      REQUIRE(tilt);
      CHECK(std::abs(tilt->pitch_rad - std::atan(down_px / 800)) < kRounding);
      CHECK(tilt->roll_rad == 0);
    }
  }
}

TEST_CASE("before a pinhole, a line through the middle gives its angle as roll, its right end up") {
  const Lens lens = pinhole(800, {639.5, 479.5});
  for (const double angle_rad : {-1.2, -0.1, 0.0, 0.3, 1.0}) {
    const glm::dvec2 along{std::cos(angle_rad), -std::sin(angle_rad)};  // y points down
    const glm::dvec2 middle{639.5, 479.5};
    for (const double from_px : {300.0, -300.0}) {  // either end
      const auto tilt = through(middle, middle + from_px * along, {}, lens);
      REQUIRE(tilt);
      CHECK(std::abs(tilt->roll_rad - angle_rad) < kRounding);
      CHECK(std::abs(tilt->pitch_rad) < kRounding);
    }
  }
  // Off the middle the angle is still the roll; the pitch is the distance from the middle.
  const double angle_rad = 0.4;
  const glm::dvec2 along{std::cos(angle_rad), -std::sin(angle_rad)};
  const glm::dvec2 across{std::sin(angle_rad), std::cos(angle_rad)};
  const glm::dvec2 foot = glm::dvec2{639.5, 479.5} + 200.0 * across;
  const auto tilt = through(foot - 90.0 * along, foot + 310.0 * along, {}, lens);
  REQUIRE(tilt);
  CHECK(std::abs(tilt->roll_rad - angle_rad) < kRounding);
  CHECK(std::abs(tilt->pitch_rad - std::atan(200.0 / 800)) < kRounding);
}

TEST_CASE("through every lens the horizon passes through the pixels that it was dragged to") {
  for (const Camera& camera : example_lenses())
    for (const glm::dvec2 a : {glm::dvec2{200, 300}, glm::dvec2{640, 700}, glm::dvec2{900, 120}})
      for (const double roll_rad : {-0.5, 0.0, 0.2}) {
        const auto lifted = lifted_to(a, roll_rad, camera.lens);
        REQUIRE(lifted);
        CHECK(lifted->roll_rad == roll_rad);
        CHECK(std::abs(slope_at(a, *lifted, camera.lens)) < kRounding);
        const glm::dvec2 b{1100, 500};
        const auto turned = through(a, b, *lifted, camera.lens);
        REQUIRE(turned);
        CHECK(std::abs(slope_at(a, *turned, camera.lens)) < kRounding);
        CHECK(std::abs(slope_at(b, *turned, camera.lens)) < kRounding);
        CHECK(std::cos(turned->roll_rad) > 0);  // not on its head
      }
}

TEST_CASE("what was drawn is dragged back: the line's own points give its roll and pitch") {
  for (const Camera& camera : example_lenses()) {
    const HorizonTilt tilt{0.15, -0.1};
    const CameraPose pose{.rotation = rotation_of({tilt.roll_rad, tilt.pitch_rad, 2.0})};
    const std::vector<PixelLine> lines = horizon_through_lens(pose, camera.lens, kSize);
    const auto grip = grip_of(lines, kSize / 2.0, kSize);
    REQUIRE(grip);
    // Drawn to half a pixel; the two lie some hundreds of pixels apart.
    const auto back = through(grip->first_px, grip->last_px, {}, camera.lens);
    REQUIRE(back);
    CHECK(std::abs(back->roll_rad - tilt.roll_rad) < 5e-3);
    CHECK(std::abs(back->pitch_rad - tilt.pitch_rad) < 5e-3);
  }
}

TEST_CASE("a line is held by its middle or by its ends") {
  const std::vector<PixelLine> level{{{-500, 400}, {1700, 400}}};
  const auto part_at = [&](double x) { return grip_of(level, {x, 410}, kSize).value().part; };
  CHECK(part_at(640) == HorizonPart::middle);
  CHECK(part_at(400) == HorizonPart::middle);
  CHECK(part_at(200) == HorizonPart::end);
  CHECK(part_at(1200) == HorizonPart::end);
  const HorizonGrip grip = grip_of(level, {640, 410}, kSize).value();
  CHECK(std::abs(grip.distance_px - 10) < kRounding);
  CHECK(std::abs(grip.middle_px.x - 640) < 150);  // a sixteenth of the piece
  CHECK(grip.on_line_px.y == 400);
  CHECK_FALSE(grip_of(std::vector<PixelLine>{{{-500, -400}, {1700, -400}}}, {640, 410}, kSize));
}

TEST_CASE("where a pixel has no ray, or both have the same, there is no horizon") {
  const Lens lens = pinhole(800, {639.5, 479.5});
  CHECK_FALSE(through({100, 100}, {100, 100}, {}, lens));
  const Camera fisheye = example_lenses().front();
  CHECK_FALSE(lifted_to({-1e5, 1e5}, 0, fisheye.lens));
}

}  // namespace sigs::editor
