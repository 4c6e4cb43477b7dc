// SPDX-License-Identifier: MIT
#include "editor/geometry/gizmo.h"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "tests/editor/geometry/cameras.h"

namespace sigs::editor {
namespace {

using namespace test;

constexpr std::array<GizmoPart, 3> kAxisParts{GizmoPart::x, GizmoPart::y, GizmoPart::z};
constexpr std::array<GizmoPart, 3> kPlaneParts{GizmoPart::xy, GizmoPart::yz, GizmoPart::zx};
constexpr std::array<int, 3> kNormals{2, 0, 1};
constexpr std::array<GizmoPart, 8> kAllParts{GizmoPart::none, GizmoPart::x,  GizmoPart::y,  GizmoPart::z,
                                             GizmoPart::xy,   GizmoPart::yz, GizmoPart::zx, GizmoPart::screen};

glm::dvec3 axis_of(int i) {
  glm::dvec3 axis{0, 0, 0};
  axis[i] = 1;
  return axis;
}

// A point beside the target, so that no line of sight is special.
glm::dvec3 beside_target(const OrbitCamera& camera) {
  return camera.target_m + glm::dvec3{0.07, -0.05, 0.06} * camera.distance_m;
}

glm::dvec3 sight(const OrbitCamera& camera, const glm::dvec3& p) {
  return camera.projection == Projection::parallel ? camera.forward() : glm::normalize(p - camera.eye_m());
}

}  // namespace

TEST_CASE("a point dragged on an axis stays on it and as near to the mouse as the axis comes") {
  int checked = 0;
  for (const OrbitCamera& camera : example_cameras())
    for (int i = 0; i < 3; ++i) {
      const glm::dvec3 start_m = beside_target(camera);
      if (glm::length(glm::cross(sight(camera, start_m), axis_of(i))) < 0.2) continue;  // end-on
      const glm::dvec2 start = camera.screen_of(start_m, kRect).value();
      const GizmoDrag drag{kAxisParts[i], start_m, start};
      for (const glm::dvec2 by : {glm::dvec2{25, 10}, glm::dvec2{-30, 5}, glm::dvec2{3, -28}}) {
        const glm::dvec3 end_m = dragged(drag, start + by, camera, kRect);
        for (int other = 0; other < 3; ++other)
          if (other != i) CHECK(end_m[other] == start_m[other]);
        // The nearest place of the axis on the screen, by brute force around the answer.
        const auto off_px = [&](double along_m) {
          return glm::distance(camera.screen_of(end_m + axis_of(i) * along_m, kRect).value(), start + by);
        };
        const double step_m = 1 / camera.pixels_per_metre(end_m, kRect);
        CHECK(off_px(0) <= off_px(step_m) + 1e-6);
        CHECK(off_px(0) <= off_px(-step_m) + 1e-6);
        CHECK(off_px(0) <= off_px(1e-3 * step_m) + 1e-6);
        ++checked;
      }
    }
  CHECK(checked > 300);
}

TEST_CASE("a point pulled along its arrow is under the mouse") {
  for (const OrbitCamera& camera : example_cameras())
    for (int i = 0; i < 3; ++i) {
      const glm::dvec3 start_m = beside_target(camera);
      if (glm::length(glm::cross(sight(camera, start_m), axis_of(i))) < 0.2) continue;
      // Where it would appear elsewhere on its axis: it moves exactly there.
      const glm::dvec3 goal_m = start_m + axis_of(i) * (0.11 * camera.distance_m);
      const GizmoDrag drag{kAxisParts[i], start_m, camera.screen_of(start_m, kRect).value()};
      const glm::dvec3 end_m = dragged(drag, camera.screen_of(goal_m, kRect).value(), camera, kRect);
      CHECK(glm::distance(end_m, goal_m) < 1e-8 * camera.distance_m);
    }
}

TEST_CASE("a point dragged in a plane stays in it and under the mouse") {
  int checked = 0;
  for (const OrbitCamera& camera : example_cameras())
    for (int i = 0; i < 3; ++i) {
      const glm::dvec3 start_m = beside_target(camera);
      if (std::abs(sight(camera, start_m)[kNormals[i]]) < 0.2) continue;  // edge-on
      const glm::dvec2 start = camera.screen_of(start_m, kRect).value();
      const glm::dvec2 grip{6, -4};  // taken beside the point: it keeps that far off
      const GizmoDrag drag{kPlaneParts[i], start_m, start + grip};
      for (const glm::dvec2 by : {glm::dvec2{25, 10}, glm::dvec2{-40, 5}, glm::dvec2{3, -28}}) {
        const glm::dvec3 end_m = dragged(drag, start + grip + by, camera, kRect);
        CHECK(end_m[kNormals[i]] == start_m[kNormals[i]]);
        CHECK(glm::distance(camera.screen_of(end_m, kRect).value(), start + by) < 1e-6);
        ++checked;
      }
    }
  CHECK(checked > 200);
}

TEST_CASE("a point dragged by the middle stays at its depth and under the mouse") {
  for (const OrbitCamera& camera : example_cameras()) {
    const glm::dvec3 start_m = beside_target(camera);
    const glm::dvec2 start = camera.screen_of(start_m, kRect).value();
    const glm::dvec2 mouse = start + glm::dvec2{-130, 77};
    const glm::dvec3 end_m = dragged({GizmoPart::screen, start_m, start}, mouse, camera, kRect);
    CHECK(glm::distance(camera.screen_of(end_m, kRect).value(), mouse) < 1e-6);
    CHECK(std::abs(glm::dot(end_m - start_m, camera.forward())) < 1e-9 * camera.distance_m);
  }
}

TEST_CASE("dragging back ends where it began, for every part and view") {
  for (const OrbitCamera& camera : example_cameras())
    for (const GizmoPart part : kAllParts) {
      const glm::dvec3 start_m = beside_target(camera);
      const GizmoDrag drag{part, start_m, {321, 222}};
      CHECK(dragged(drag, {321, 222}, camera, kRect) == start_m);
      CHECK(dragged(drag, {321, 222}, camera, kRect, 25) == start_m);  // a click alone snaps nothing
    }
}

TEST_CASE("an axis seen end-on and a plane seen edge-on move nothing") {
  const OrbitCamera along_x{};
  const GizmoDrag axis{GizmoPart::x, {0, 0, 0}, {500, 350}};
  CHECK(dragged(axis, {560, 300}, along_x, kRect) == glm::dvec3{0, 0, 0});
  const GizmoDrag plane{GizmoPart::xy, {0, 0, 0}, {500, 350}};
  CHECK(dragged(plane, {560, 300}, along_x, kRect) == glm::dvec3{0, 0, 0});
  OrbitCamera parallel = along_x;
  parallel.projection = Projection::parallel;
  CHECK(dragged(axis, {560, 300}, parallel, kRect) == glm::dvec3{0, 0, 0});
  CHECK(dragged(plane, {560, 300}, parallel, kRect) == glm::dvec3{0, 0, 0});
}

TEST_CASE("beyond the horizon of a plane and the vanishing point of an axis the point stays") {
  const OrbitCamera camera{.elevation_rad = 0.2};  // the horizon is within the screen
  const glm::dvec2 middle = (kRect.low + kRect.high) / 2.0;
  // Where the plane's far edge is seen: far points of it converge there.
  const double horizon_y = camera.screen_of({1e12, 0, 0}, kRect)->y;
  REQUIRE(horizon_y > kRect.low.y);
  for (const GizmoPart part : {GizmoPart::xy, GizmoPart::x}) {
    const GizmoDrag drag{part, {0, 0, 0}, middle};
    const glm::dvec3 below = dragged(drag, {middle.x, horizon_y + 5}, camera, kRect);
    CHECK(below.x > 10000);
    CHECK(dragged(drag, {middle.x, horizon_y - 5}, camera, kRect) == glm::dvec3{0, 0, 0});
    const glm::dvec3 at = dragged(drag, {middle.x, horizon_y}, camera, kRect);
    CHECK(is_finite(at));
  }
}

TEST_CASE("the answer is finite and within 1e8 m for whatever the mouse does") {
  const std::vector<glm::dvec2> mice{{kNan, 3},      {3, kNan},   {kInfinity, -kInfinity},
                                     {1e300, 1e300}, {-1e9, 1e9}, {500, 349.9},
                                     {500, 1e7},     {100, 50},   {0, 0}};
  for (OrbitCamera camera : example_cameras())
    for (const glm::dvec3 target : {glm::dvec3{0, 0, 0}, glm::dvec3{1e7, -1e7, 1e7}, glm::dvec3{1e8, 1e8, -1e8}})
      for (const GizmoPart part : kAllParts)
        for (const glm::dvec2& mouse : mice)
          for (const double snap_m : {0.0, 3e7, kNan, -1.0}) {
            camera.target_m = target;
            const glm::dvec3 end_m = dragged({part, target, {500, 350}}, mouse, camera, kRect, snap_m);
            CHECK(is_finite(end_m));
            CHECK(glm::length(glm::max(glm::abs(end_m) - 1e8, 0.0)) == 0);
          }
  const glm::dvec3 nowhere = dragged({GizmoPart::x, {kNan, kInfinity, 5}, {1, 1}}, {2, 2}, OrbitCamera{}, kRect);
  CHECK(nowhere == glm::dvec3{0, 1e8, 5});
}

TEST_CASE("ten thousand kilometres out a drag is still under the mouse") {
  const OrbitCamera camera{.target_m = {1e7, -1e7, -1e4}, .distance_m = 500, .bearing_rad = 0.7, .elevation_rad = 0.6};
  const glm::dvec2 start = camera.screen_of(camera.target_m, kRect).value();
  for (const GizmoPart part : {GizmoPart::xy, GizmoPart::yz, GizmoPart::zx, GizmoPart::screen}) {
    const glm::dvec2 mouse = start + glm::dvec2{40, 30};
    const glm::dvec3 end_m = dragged({part, camera.target_m, start}, mouse, camera, kRect);
    CHECK(glm::distance(camera.screen_of(end_m, kRect).value(), mouse) < 1e-5);  // doubles hold 2e-9 m there
  }
}

TEST_CASE("a point that is not in view stays where it is") {
  const OrbitCamera camera{};
  CHECK(dragged({GizmoPart::y, {-2000, 1, 2}, {5, 5}}, {50, 60}, camera, kRect) == glm::dvec3{-2000, 1, 2});
}

TEST_CASE("snapping rounds the coordinates that move and no others") {
  const OrbitCamera camera{.bearing_rad = 0.4, .elevation_rad = 0.7};
  const glm::dvec3 start_m{1.3, 2.7, -151.9};
  const glm::dvec2 start = camera.screen_of(start_m, kRect).value();
  const auto is_multiple = [](double value) { return std::abs(std::remainder(value, 5)) < 1e-9; };
  const glm::dvec3 on_y = dragged({GizmoPart::y, start_m, start}, start + glm::dvec2{60, 10}, camera, kRect, 5);
  CHECK((on_y.x == start_m.x && on_y.z == start_m.z && is_multiple(on_y.y)));
  CHECK(on_y.y != 5);  // it did move
  const glm::dvec3 in_zx = dragged({GizmoPart::zx, start_m, start}, start + glm::dvec2{60, 10}, camera, kRect, 5);
  CHECK((in_zx.y == start_m.y && is_multiple(in_zx.z) && is_multiple(in_zx.x)));
  const glm::dvec3 free = dragged({GizmoPart::screen, start_m, start}, start + glm::dvec2{60, 10}, camera, kRect, 5);
  CHECK((is_multiple(free.x) && is_multiple(free.y) && is_multiple(free.z)));
}

TEST_CASE("seen from above, the middle moves and snaps nothing in height") {
  const OrbitCamera camera{.elevation_rad = std::numbers::pi / 2, .projection = Projection::parallel};
  const glm::dvec3 start_m{1.3, 2.7, -151.9};
  const glm::dvec2 start = camera.screen_of(start_m, kRect).value();
  const glm::dvec3 end_m = dragged({GizmoPart::screen, start_m, start}, start + glm::dvec2{60, 10}, camera, kRect, 10);
  CHECK(end_m.z == start_m.z);
  CHECK(end_m.y > start_m.y);
}

TEST_CASE("the gizmo has its size on the screen, however far it is") {
  for (const double distance_m : {5.0, 1000.0, 1e7}) {
    const OrbitCamera camera{.distance_m = distance_m, .bearing_rad = 0.6, .elevation_rad = 0.5};
    const auto shape = gizmo_shape({}, camera, kRect);
    REQUIRE(shape.has_value());
    CHECK(glm::distance(shape->center, {500, 350}) < 1e-9);
    for (const auto& tip : shape->tips) {
      REQUIRE(tip.has_value());
      CHECK(glm::distance(*tip, shape->center) < 90 * 1.1);
      CHECK(glm::distance(*tip, shape->center) > 30);
    }
    for (const auto& plane : shape->planes) CHECK(plane.has_value());
  }
}

TEST_CASE("arrows point where their axes go") {
  const OrbitCamera camera{.elevation_rad = std::numbers::pi / 2};  // from above: X up, Y right
  const auto shape = gizmo_shape({}, camera, kRect).value();
  CHECK(glm::distance(*shape.tips[0], {500, 260}) < 1e-6);
  CHECK(glm::distance(*shape.tips[1], {590, 350}) < 1e-6);
  CHECK_FALSE(shape.tips[2].has_value());
  CHECK(shape.planes[0].has_value());
  CHECK_FALSE(shape.planes[1].has_value());
  CHECK_FALSE(shape.planes[2].has_value());
}

TEST_CASE("no gizmo is drawn where its centre is not in view") {
  CHECK_FALSE(gizmo_shape({.center_m = {-5000, 0, 0}}, OrbitCamera{}, kRect).has_value());
  CHECK_FALSE(gizmo_shape({.center_m = {kNan, 0, 0}}, OrbitCamera{}, kRect).has_value());
}

TEST_CASE("the mouse takes the middle before planes before arrows") {
  const OrbitCamera camera{.bearing_rad = 0.6, .elevation_rad = 0.5};
  const auto shape = gizmo_shape({}, camera, kRect).value();
  CHECK(part_at(shape, shape.center) == GizmoPart::screen);
  CHECK(part_at(shape, shape.center + glm::dvec2{6, 0}) == GizmoPart::screen);
  for (int i = 0; i < 3; ++i) {
    CHECK(part_at(shape, *shape.tips[i]) == kAxisParts[i]);
    glm::dvec2 middle{0, 0};
    for (const glm::dvec2& corner : *shape.planes[i]) middle += corner / 4.0;
    CHECK(part_at(shape, middle) == kPlaneParts[i]);
    const glm::dvec2 beyond = *shape.tips[i] + glm::normalize(*shape.tips[i] - shape.center) * 8.0;
    CHECK(part_at(shape, beyond) == GizmoPart::none);
    CHECK(part_at(shape, beyond, 9) == kAxisParts[i]);
  }
  CHECK(part_at(shape, {0, 0}) == GizmoPart::none);
  CHECK(part_at(shape, {kNan, 350}) == GizmoPart::none);
}

TEST_CASE("the snapping step is round and some eight pixels on the screen") {
  for (const OrbitCamera& camera : example_cameras()) {
    const double step_px =
        snap_step_m(camera, camera.target_m, kRect) * camera.pixels_per_metre(camera.target_m, kRect);
    CHECK(step_px >= 8 * (1 - 1e-9));
    CHECK(step_px <= 20 * (1 + 1e-9));
  }
}

}  // namespace sigs::editor
