// SPDX-License-Identifier: MIT

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "editor/geometry/lens_projection.h"
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

TEST_CASE("a point behind a pixel is at the given distance and projects to that pixel") {
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

TEST_CASE("a point dragged across the footage follows the mouse at its distance, with a fixed offset") {
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

TEST_CASE("projecting and unprojecting gives the same point, through each lens") {
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

namespace {

using test::example_lenses;

const glm::dvec2 kSize{1280, 960};
const CameraPose kPose{.rotation = rotation_of({0.1, -0.05, 0.3}), .translation_m = {1000, 0, -150}};

double distance_to(const std::vector<PixelLine>& lines, const glm::dvec2& p) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const PixelLine& line : lines)
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
      const glm::dvec2 along = line[i + 1] - line[i];
      const double length_2 = glm::dot(along, along);
      const double share = length_2 > 0 ? std::clamp(glm::dot(p - line[i], along) / length_2, 0.0, 1.0) : 0;
      nearest = std::min(nearest, glm::distance(p, line[i] + along * share));
    }
  return nearest;
}

bool in_image(const glm::dvec2& p) {
  return p.x >= 0 && p.y >= 0 && p.x < kSize.x && p.y < kSize.y;
}

// Circles the camera and comes close to it.
glm::dvec3 spiral(double t) {
  return kPose.translation_m + glm::dvec3{60 * std::cos(2 * t) + 20, 40 * std::sin(2 * t), 10 * std::sin(5 * t)};
}

}  // namespace

TEST_CASE("a path through a lens is drawn to half a pixel wherever it is in the image") {
  const std::vector<double> times{0, 1, 2, 5};
  for (const Camera& camera : example_lenses()) {
    const auto lines = path_through_lens(spiral, times, kPose, camera.lens, kSize);
    int observed = 0;
    for (double t = 0; t <= 5; t += 0.0037) {
      const auto pixel = pixel_of(spiral(t), kPose, camera.lens);
      if (!pixel || !in_image(*pixel)) continue;
      ++observed;
      CHECK(distance_to(lines, *pixel) < 0.5);
    }
    CHECK(observed > 50);
  }
}

TEST_CASE("a path that passes behind the camera is broken there") {
  const Camera pinhole = example_lenses()[2];
  const auto lines = path_through_lens(spiral, std::vector<double>{0, 6}, kPose, pinhole.lens, kSize);
  CHECK(lines.size() >= 2);
  for (const PixelLine& line : lines)
    for (const glm::dvec2& p : line) CHECK((std::abs(p.x) < 1e5 && std::abs(p.y) < 1e5));
}

// Straight lines from point to point, a second each.
std::vector<PixelLine> points_through_lens(const std::vector<glm::dvec3>& points_m, const Lens& lens) {
  std::vector<double> times;
  for (std::size_t i = 0; i < points_m.size(); ++i) times.push_back(static_cast<double>(i));
  const auto position_m = [&](double t) {
    const std::size_t leg = std::min(static_cast<std::size_t>(t), points_m.size() - 2);
    return glm::mix(points_m[leg], points_m[leg + 1], t - static_cast<double>(leg));
  };
  return path_through_lens(position_m, times, kPose, lens, kSize);
}

TEST_CASE("straight lines of points stay straight through a pinhole and are within half a pixel through any lens") {
  const std::vector<glm::dvec3> points{kPose * glm::dvec3{300, -100, -60}, kPose * glm::dvec3{400, 150, 30},
                                       kPose * glm::dvec3{90, 10, 30}};
  for (const Camera& camera : example_lenses()) {
    const auto lines = points_through_lens(points, camera.lens);
    REQUIRE(lines.size() == 1);
    for (std::size_t leg = 0; leg < 2; ++leg)
      for (double share = 0; share <= 1; share += 0.01)
        CHECK(distance_to(lines, *pixel_of(glm::mix(points[leg], points[leg + 1], share), kPose, camera.lens)) < 0.5);
  }
}

TEST_CASE("no points, one point and points that are not finite give no line") {
  const Camera camera = example_lenses()[0];
  CHECK(points_through_lens({}, camera.lens).empty());
  const std::vector<glm::dvec3> one{{2000, 0, -150}};
  CHECK(points_through_lens(one, camera.lens).empty());
  const std::vector<glm::dvec3> none(3, glm::dvec3{std::nan(""), 0, 0});
  CHECK(points_through_lens(none, camera.lens).empty());
}

TEST_CASE("the horizon through a lens looks level: rays behind it have no slope") {
  for (const Camera& camera : example_lenses()) {
    const auto lines = horizon_through_lens(kPose, camera.lens, kSize);
    REQUIRE_FALSE(lines.empty());
    int checked = 0;
    for (const PixelLine& line : lines)
      for (std::size_t i = 0; i + 1 < line.size(); ++i) {
        const glm::dvec2 middle = (line[i] + line[i + 1]) / 2.0;
        const auto ray = in_image(middle) ? camera.lens.ray(middle) : std::nullopt;
        if (!ray) continue;
        const double slope = (kPose.rotation * *ray).z;
        CHECK(std::abs(slope) < 0.5 / 400);  // half a pixel, where some 400 px or more are a radian
        ++checked;
      }
    CHECK(checked > 3);
  }
}

namespace {

using test::example_lenses;

constexpr double kRounding = 1e-9;

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

TEST_CASE("dragging to the drawn line's own points gives its roll and pitch") {
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

TEST_CASE("lines that leave a 360 degree image on one side come in on the other, and never cross it") {
  const Camera around = equirectangular_camera({1024, 512});
  const glm::dvec2 size(1024, 512);
  const auto check_unbroken = [&](const std::vector<PixelLine>& lines) {
    REQUIRE_FALSE(lines.empty());
    double low = 1e9, high = -1e9;
    for (const PixelLine& line : lines)
      for (std::size_t i = 1; i < line.size(); ++i) {
        CHECK(std::abs(line[i].x - line[i - 1].x) < 512);
        low = std::min({low, line[i].x, line[i - 1].x});
        high = std::max({high, line[i].x, line[i - 1].x});
      }
    CHECK(low < 0.5);  // up to the sides
    CHECK(high > 1022.5);
  };
  for (const glm::dvec3& attitude : {glm::dvec3(0, 0, 0), glm::dvec3(0.3, -0.2, 1.1)}) {
    const CameraPose pose{.rotation = rotation_of({attitude.x, attitude.y, attitude.z}), .translation_m = {0, 0, -150}};
    check_unbroken(horizon_through_lens(pose, around.lens, size));
  }
  const auto behind = [](double t_s) { return glm::dvec3(-100, 30 * t_s - 60, -170); };
  const std::vector<PixelLine> passing =
      path_through_lens(behind, std::vector<double>{0, 2, 4}, kLevel, around.lens, size);
  CHECK(passing.size() == 2);
  check_unbroken(passing);
  // Over the zenith, where the azimuth turns by half a turn at once.
  const auto over = [](double t_s) { return glm::dvec3(50 * t_s - 100, 0.01, -250); };
  for (const PixelLine& line : path_through_lens(over, std::vector<double>{0, 2, 4}, kLevel, around.lens, size))
    for (std::size_t i = 1; i < line.size(); ++i) CHECK(std::abs(line[i].x - line[i - 1].x) <= 512);
}

}  // namespace sigs::editor
