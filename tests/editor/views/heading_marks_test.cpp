// SPDX-License-Identifier: MIT
#include "editor/views/viewport/horizon_tool.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/pose.h"

using namespace sigs;
using namespace sigs::editor;

namespace {

constexpr double kFocal_px = 1000;
const glm::dvec2 kImage_px{1280, 960};

FootageCamera pinhole(const Attitude& attitude) {
  return {.frame = 0,
          .world_from_camera = {rotation_of(attitude), {5, 6, -150}},
          .lens = *Lens::make({LensModel::brown_conrady, kFocal_px, kFocal_px, 639.5, 479.5, {}})};
}

const HeadingMark* mark_at(const std::vector<HeadingMark>& marks, double heading_deg) {
  const auto found =
      std::find_if(marks.begin(), marks.end(), [&](const HeadingMark& m) { return m.heading_deg == heading_deg; });
  return found == marks.end() ? nullptr : &*found;
}

}  // namespace

TEST_CASE("a level pinhole sees the heading h at f * tan(h - its own), on the row of the horizon") {
  const double yaw_deg = 20;
  const auto marks = heading_marks(pinhole({.yaw_rad = rad_of_deg(yaw_deg)}), kImage_px, 0, 7);
  for (const double heading_deg : {0.0, 10.0, 20.0, 45.0, 350.0}) {
    const HeadingMark* const mark = mark_at(marks, heading_deg);
    CAPTURE(heading_deg);
    REQUIRE(mark != nullptr);
    CHECK(mark->pixel.x == doctest::Approx(639.5 + kFocal_px * std::tan(rad_of_deg(heading_deg - yaw_deg))));
    CHECK(mark->pixel.y == doctest::Approx(479.5));
    CHECK(glm::distance(mark->up, glm::dvec2(0, -1)) < 1e-9);
  }
  CHECK(mark_at(marks, 180) == nullptr);  // behind
  CHECK(mark_at(marks, 55) == nullptr);   // 20 + atan(640 / 1000) = 52.6 is the image's edge
}

TEST_CASE("against north, marks are shifted by the heading of world X") {
  const auto marks = heading_marks(pinhole({}), kImage_px, rad_of_deg(90), 7);
  REQUIRE(mark_at(marks, 90) != nullptr);
  CHECK(mark_at(marks, 90)->pixel.x == doctest::Approx(639.5));
  CHECK(mark_at(marks, 0) == nullptr);
}

TEST_CASE("a camera with its right side down has the marks' tops leaning to the left") {
  const double roll_rad = rad_of_deg(30);
  const auto marks = heading_marks(pinhole({.roll_rad = roll_rad}), kImage_px, 0, 7);
  REQUIRE(mark_at(marks, 0) != nullptr);
  CHECK(glm::distance(mark_at(marks, 0)->up, glm::dvec2(-std::sin(roll_rad), -std::cos(roll_rad))) < 1e-6);
}

TEST_CASE("numbers stand as far apart as their text needs, on every fifth degree at most") {
  const auto numbered = [](double number_gap_deg) {
    const auto marks = heading_marks(pinhole({}), kImage_px, 0, number_gap_deg);
    return std::count_if(marks.begin(), marks.end(), [](const HeadingMark& m) { return m.is_numbered; });
  };
  // The image reaches to atan(640 / 1000) = 32.6 degrees on both sides.
  CHECK(numbered(0.1) == 13);
  CHECK(numbered(5) == 13);
  CHECK(numbered(6) == 7);
  CHECK(numbered(25) == 3);
  CHECK(numbered(1e9) == 1);
}

TEST_CASE("headings are written as in aviation against north, and to both sides against world X") {
  CHECK(heading_text(45, true) == "045");
  CHECK(heading_text(270, true) == "W");
  CHECK(heading_text(0, true) == "N");
  CHECK(heading_text(350, false) == "-10\u00b0");
  CHECK(heading_text(180, false) == "180\u00b0");
}
