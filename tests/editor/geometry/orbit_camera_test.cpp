// SPDX-License-Identifier: MIT

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <initializer_list>
#include <numbers>

#include "editor/geometry/orbit_camera.h"
#include "tests/editor/geometry/cameras.h"

namespace sigs::editor {
namespace {

using namespace test;

// The textbook projection to the screen: OpenGL's matrices in homogeneous coordinates.
glm::dvec2 matrix_screen(const OrbitCamera& camera, const glm::dvec3& p_m, const ScreenRect& rect) {
  const glm::dvec2 size = rect.size();
  const double aspect = size.x / size.y;
  const double half = std::tan(camera.field_rad / 2);
  const double half_y = size.x < size.y ? half / aspect : half;
  const glm::dvec3 up = std::abs(camera.elevation_rad) > 1.57
                            ? glm::dvec3{std::cos(camera.bearing_rad), std::sin(camera.bearing_rad), 0}
                            : glm::dvec3{0, 0, -1};
  const double d = camera.distance_m;
  const glm::dmat4 view = glm::lookAt(camera.eye_m(), camera.target_m, up);
  const glm::dmat4 lens = camera.projection == Projection::perspective
                              ? glm::perspective(2 * std::atan(half_y), aspect, d / 1000, d * 1000)
                              : glm::ortho(-half_y * aspect * d, half_y * aspect * d, -half_y * d, half_y * d);
  const glm::dvec4 clip = lens * (view * glm::dvec4(p_m, 1));
  const glm::dvec2 device = glm::dvec2(clip) / clip.w;
  return rect.low + (glm::dvec2{device.x, -device.y} + 1.0) / 2.0 * size;
}

std::vector<glm::dvec3> points_around(const OrbitCamera& camera) {
  std::vector<glm::dvec3> points;
  for (const double x : {-0.4, 0.0, 0.3})
    for (const double y : {-0.2, 0.35})
      for (const double z : {-0.3, 0.25}) points.push_back(camera.target_m + glm::dvec3{x, y, z} * camera.distance_m);
  return points;
}

}  // namespace

TEST_CASE("the eye's axes are right-handed and of unit length, from above too") {
  for (const OrbitCamera& camera : example_cameras()) {
    CHECK(glm::length(camera.forward()) == doctest::Approx(1));
    CHECK(glm::length(glm::cross(camera.right(), camera.forward()) - camera.up()) < 1e-12);
    CHECK(glm::length(camera.eye_m() + camera.forward() * camera.distance_m - camera.target_m) < 1e-9);
  }
  OrbitCamera above{.elevation_rad = std::numbers::pi / 2};
  CHECK(glm::length(above.up() - glm::dvec3{1, 0, 0}) < 1e-12);
  CHECK(glm::length(above.right() - glm::dvec3{0, 1, 0}) < 1e-12);
  CHECK(above.eye_m().z == doctest::Approx(-1000));
  CHECK(glm::length(OrbitCamera{}.up() - glm::dvec3{0, 0, -1}) < 1e-12);
}

TEST_CASE("points are projected to the screen as by OpenGL's matrices") {
  for (const ScreenRect& rect : {kRect, ScreenRect{{0, 0}, {300, 700}}})
    for (const OrbitCamera& camera : example_cameras())
      for (const glm::dvec3& point : points_around(camera)) {
        const auto screen = camera.screen_of(point, rect);
        REQUIRE(screen.has_value());
        CHECK(glm::distance(*screen, matrix_screen(camera, point, rect)) < 1e-6);
      }
}

TEST_CASE("the ray through a screen position meets the point shown there") {
  for (const OrbitCamera& camera : example_cameras())
    for (const glm::dvec3& point : points_around(camera)) {
      const Ray ray = camera.ray_at(camera.screen_of(point, kRect).value(), kRect);
      CHECK(glm::length(ray.direction) == doctest::Approx(1));
      const glm::dvec3 to_point = point - ray.origin_m;
      CHECK(glm::length(glm::cross(to_point, ray.direction)) < 1e-9 * camera.distance_m * 10);
      CHECK(glm::dot(to_point, ray.direction) > 0);
    }
}

TEST_CASE("pixels per metre is how fast a point moves across the screen") {
  for (const OrbitCamera& camera : example_cameras())
    for (const glm::dvec3& point : points_around(camera)) {
      const double step_m = camera.distance_m * 1e-4;
      const glm::dvec2 a = camera.screen_of(point, kRect).value();
      const glm::dvec2 b = camera.screen_of(point + camera.right() * step_m, kRect).value();
      CHECK(glm::distance(a, b) / step_m == doctest::Approx(camera.pixels_per_metre(point, kRect)).epsilon(1e-6));
    }
}

TEST_CASE("both projections show the target's depth at the same size") {
  OrbitCamera camera{.bearing_rad = 1, .elevation_rad = 0.4};
  const double perspective = camera.pixels_per_metre(camera.target_m, kRect);
  camera.projection = Projection::parallel;
  CHECK(camera.pixels_per_metre(camera.target_m, kRect) == doctest::Approx(perspective));
  CHECK(perspective * 2 * 1000 * std::tan(0.4) == doctest::Approx(600));  // the field spans the shorter side
}

TEST_CASE("a point behind the eye or not finite has no screen position") {
  const OrbitCamera camera{};  // at -1000, looks along X
  CHECK_FALSE(camera.screen_of({-1001, 0, 0}, kRect).has_value());
  CHECK_FALSE(camera.screen_of({-1000, 0, 0}, kRect).has_value());
  CHECK_FALSE(camera.screen_of({-999.1, 0, 0}, kRect).has_value());
  CHECK(camera.screen_of({-998.9, 0, 0}, kRect).has_value());
  CHECK_FALSE(camera.screen_of({kNan, 0, 0}, kRect).has_value());
  CHECK_FALSE(camera.screen_of({kInfinity, 0, 0}, kRect).has_value());
  const OrbitCamera parallel{.projection = Projection::parallel};
  CHECK(parallel.screen_of({-5000, 7, 0}, kRect) == parallel.screen_of({5000, 7, 0}, kRect));
}

TEST_CASE("a rectangle of no size crashes nothing") {
  for (const OrbitCamera& camera : example_cameras()) {
    CHECK(std::isfinite(camera.pixels_per_metre(camera.target_m, {})));
    CHECK(camera.screen_of(camera.target_m, {}).has_value());
    CHECK(std::isfinite(camera.ray_at({0, 0}, {}).direction.x));
    CHECK(std::isfinite(framing(camera, points_around(camera), {}).distance_m));
  }
}

TEST_CASE("a line in view runs from end to end") {
  for (const OrbitCamera& camera : example_cameras()) {
    const std::vector<glm::dvec3> points = points_around(camera);
    const auto line = screen_line(camera, kRect, points[0], points[7]);
    REQUIRE(line.has_value());
    CHECK(glm::distance((*line)[0], camera.screen_of(points[0], kRect).value()) < 1e-9);
    CHECK(glm::distance((*line)[1], camera.screen_of(points[7], kRect).value()) < 1e-9);
  }
}

TEST_CASE("a line that passes behind the eye is cut, and what is left of it is the same line") {
  const OrbitCamera camera{};
  const glm::dvec3 before{-900, 20, 10};
  const glm::dvec3 behind{-1100, 30, -40};
  const auto line = screen_line(camera, kRect, before, behind);
  REQUIRE(line.has_value());
  CHECK((*line)[0] == camera.screen_of(before, kRect).value());
  // A place well on the way, projected, lies on the line drawn.
  const glm::dvec2 on_way = camera.screen_of(glm::mix(before, behind, 0.3), kRect).value();
  const glm::dvec2 along = glm::normalize((*line)[1] - (*line)[0]);
  const glm::dvec2 to = on_way - (*line)[0];
  CHECK(std::abs(along.x * to.y - along.y * to.x) < 1e-6);
  CHECK(glm::dot(along, to) > 0);
  const auto turned = screen_line(camera, kRect, behind, before);
  CHECK((*turned)[1] == (*line)[0]);
  CHECK_FALSE(screen_line(camera, kRect, {-1001, 0, 0}, behind).has_value());
  CHECK_FALSE(screen_line(camera, kRect, before, {kNan, 0, 0}).has_value());
}

TEST_CASE("the ends of a line fit floats, however close to the eye it passes") {
  const OrbitCamera camera{.target_m = {0, 0, 1e7}};
  const auto line = screen_line(camera, kRect, {0, 1, 1e7}, {-999, 5e6, 1e7});
  REQUIRE(line.has_value());
  for (const glm::dvec2& end : *line) {
    CHECK(end.x >= kRect.low.x - 10001);
    CHECK(end.x <= kRect.high.x + 10001);
  }
  CHECK_FALSE(screen_line(camera, kRect, {-998, 1e6, 1e7}, {-998, 2e6, 1e7}).has_value());
}

TEST_CASE("orbiting keeps the target in the middle and turns it with the mouse") {
  for (const OrbitCamera& camera : example_cameras()) {
    const OrbitCamera turned = orbited(camera, {40, -25});
    CHECK(glm::distance(turned.screen_of(turned.target_m, kRect).value(), (kRect.low + kRect.high) / 2.0) < 1e-6);
    CHECK(turned.distance_m == camera.distance_m);
  }
  // What is on the near side of the target follows the mouse.
  const OrbitCamera camera{};
  const glm::dvec3 near_side{-100, 0, 0};
  CHECK(orbited(camera, {20, 0}).screen_of(near_side, kRect)->x > camera.screen_of(near_side, kRect)->x);
  CHECK(orbited(camera, {0, 20}).screen_of(near_side, kRect)->y > camera.screen_of(near_side, kRect)->y);
}

TEST_CASE("elevation is limited at the vertical and bearing wraps around") {
  OrbitCamera camera{};
  CHECK(orbited(camera, {0, 1e9}).elevation_rad == doctest::Approx(std::numbers::pi / 2));
  CHECK(orbited(camera, {0, -1e9}).elevation_rad == doctest::Approx(-std::numbers::pi / 2));
  for (int i = 0; i < 1000; ++i) camera = orbited(camera, {100, 0});
  CHECK(std::abs(camera.bearing_rad) <= std::numbers::pi + 1e-12);
  CHECK(std::cos(camera.bearing_rad) == doctest::Approx(std::cos(500.0)).epsilon(1e-9));
  CHECK(orbited(camera, {kNan, 3}).bearing_rad == camera.bearing_rad);
}

TEST_CASE("panning moves what lies at the target's depth with the mouse") {
  for (const OrbitCamera& camera : example_cameras()) {
    const glm::dvec2 by{37, -81};
    const OrbitCamera moved = panned(camera, by, kRect);
    const glm::dvec3 beside = camera.target_m + (camera.right() - camera.up()) * camera.distance_m * 0.1;
    const glm::dvec2 expected = camera.screen_of(beside, kRect).value() + by;
    CHECK(glm::distance(moved.screen_of(beside, kRect).value(), expected) < 1e-6);
    CHECK(panned(camera, {kNan, 0}, kRect).target_m == camera.target_m);
  }
}

TEST_CASE("zooming in keeps the point under the cursor at the target's depth") {
  const glm::dvec2 cursor{250, 500};
  for (const OrbitCamera& camera : example_cameras())
    for (const double factor : {0.5, 0.95, 1.3, 8.0}) {
      const Ray ray = camera.ray_at(cursor, kRect);
      const double along_m = camera.distance_m / glm::dot(ray.direction, camera.forward());
      const OrbitCamera nearer = approached(camera, factor, cursor, kRect);
      const auto screen = nearer.screen_of(ray.origin_m + ray.direction * along_m, kRect);
      REQUIRE(screen.has_value());
      CHECK(glm::distance(*screen, cursor) < 1e-6);
      if (nearer.distance_m > 0.1) CHECK(nearer.distance_m == doctest::Approx(camera.distance_m / factor));
    }
}

TEST_CASE("distance stays within its limits and an invalid factor changes nothing") {
  const OrbitCamera camera{};
  CHECK(approached(camera, 1e300, {200, 200}, kRect).distance_m == 0.1);
  CHECK(approached(camera, kInfinity, {200, 200}, kRect).distance_m == 0.1);
  CHECK(approached(camera, 1e-300, {200, 200}, kRect).distance_m == 1e9);
  CHECK(std::isfinite(approached(camera, 1e-300, {200, 200}, kRect).target_m.y));
  for (const double factor : {0.0, -1.0, kNan})
    CHECK(approached(camera, factor, {200, 200}, kRect).distance_m == camera.distance_m);
  CHECK(approached(camera, 2, {kNan, 200}, kRect).distance_m == camera.distance_m);
}

TEST_CASE("framed points are all in view, with a margin, and fill the screen") {
  for (const ScreenRect& rect : {kRect, ScreenRect{{0, 0}, {300, 700}}})
    for (const OrbitCamera& camera : example_cameras()) {
      const std::vector<glm::dvec3> points{{0, 0, -150}, {900, -100, -200}, {1500, 400, -80}, {1e4, 30, -151}};
      const OrbitCamera framed = framing(camera, points, rect);
      CHECK(framed.bearing_rad == camera.bearing_rad);
      CHECK(framed.elevation_rad == camera.elevation_rad);
      const glm::dvec2 half = rect.size() / 2.0;
      double farthest = 0;
      for (const glm::dvec3& point : points) {
        const auto screen = framed.screen_of(point, rect);
        REQUIRE(screen.has_value());
        const glm::dvec2 share = glm::abs(*screen - (rect.low + rect.high) / 2.0) / half;
        farthest = std::max({farthest, share.x, share.y});
      }
      CHECK(farthest <= 0.9);
      CHECK(farthest >= 0.3);
    }
}

TEST_CASE("points in a row behind each other are framed before the eye") {
  const std::vector<glm::dvec3> row{{0, 0, 0}, {10, 0, 0}, {1e7, 0, 0}};
  const OrbitCamera framed = framing(OrbitCamera{}, row, kRect);
  for (const glm::dvec3& point : row) CHECK(framed.screen_of(point, kRect).has_value());
}

TEST_CASE("framing no points changes nothing, framing one turns the eye towards it") {
  const OrbitCamera camera{.target_m = {1, 2, 3}};
  CHECK(framing(camera, {}, kRect).target_m == camera.target_m);
  const std::vector<glm::dvec3> none{{kNan, 0, 0}};
  CHECK(framing(camera, none, kRect).target_m == camera.target_m);
  const std::vector<glm::dvec3> place{{70, 80, 90}, {70, 80, 90}};
  const OrbitCamera framed = framing(camera, place, kRect);
  CHECK(glm::distance(framed.target_m, place[0]) < 1e-9);
  CHECK(framed.distance_m == camera.distance_m);
}

constexpr double kPi = std::numbers::pi;

TEST_CASE("a light's bearing turns right from world X and its elevation is up") {
  const glm::dvec3 from{100, 200, -150};
  CHECK(direction_of(from + glm::dvec3{10, 0, 0}, from).bearing_rad == 0);
  CHECK(direction_of(from + glm::dvec3{0, 10, 0}, from).bearing_rad == doctest::Approx(kPi / 2));
  CHECK(direction_of(from + glm::dvec3{0, -10, 0}, from).bearing_rad == doctest::Approx(-kPi / 2));
  const LightDirection up = direction_of(from + glm::dvec3{0, 0, -10}, from);
  CHECK(up.elevation_rad == doctest::Approx(kPi / 2));
  CHECK(up.bearing_rad == 0);
  CHECK(up.distance_m == 10);
  CHECK(direction_of(from + glm::dvec3{3, 4, 5}, from).elevation_rad == doctest::Approx(-kPi / 4));
}

TEST_CASE("straight back is bearing +pi from either side of zero") {
  CHECK(direction_of({-1, 0.0, 0}, {0, 0, 0}).bearing_rad == doctest::Approx(kPi));
  CHECK(direction_of({-1, -0.0, 0}, {0, 0.0, 0}).bearing_rad == doctest::Approx(kPi));
  CHECK(direction_of({-1, -1e-300, 0}, {0, 0, 0}).bearing_rad == doctest::Approx(kPi));
}

TEST_CASE("a light at the reference point has neither direction nor distance") {
  const LightDirection none = direction_of({4, 5, 6}, {4, 5, 6});
  CHECK((none.bearing_rad == 0 && none.elevation_rad == 0 && none.distance_m == 0));
  CHECK(position_of({1, 1, 0}, {4, 5, 6}) == glm::dvec3{4, 5, 6});
}

TEST_CASE("position and direction are each other's inverse, far and near") {
  for (const double distance_m : {1e-3, 50.0, 1e7})
    for (const double bearing_rad : {-3.1, -0.4, 0.0, 2.0, kPi})
      for (const double elevation_rad : {-1.5, 0.0, 0.3, 1.57}) {
        const glm::dvec3 from{1, -2, 0.5};
        const LightDirection back = direction_of(position_of({bearing_rad, elevation_rad, distance_m}, from), from);
        // A millimetre beside a metre has 13 of a double's 16 digits, and next to the zenith they make up the bearing.
        CHECK(back.bearing_rad == doctest::Approx(bearing_rad).epsilon(1e-8).scale(1));
        CHECK(back.elevation_rad == doctest::Approx(elevation_rad).epsilon(1e-10).scale(1));
        CHECK(back.distance_m == doctest::Approx(distance_m).epsilon(1e-10));
      }
}

}  // namespace sigs::editor
