// SPDX-License-Identifier: MIT
#include "editor/geometry/gizmo.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <numbers>

using namespace sigs;
using namespace sigs::editor;

namespace {

const ScreenRect kView{{100, 50}, {900, 650}};
const PlaneDrag kAcross{.start_m = {400, 20, -150}, .axes = {glm::dvec3(0, 1, 0), glm::dvec3(0, 0, -1)}};

OrbitCamera looking(double bearing_rad, double elevation_rad, Projection projection) {
  return {.target_m = {350, 0, -140},
          .distance_m = 600,
          .bearing_rad = bearing_rad,
          .elevation_rad = elevation_rad,
          .projection = projection};
}

}  // namespace

TEST_CASE("a point dragged in a plane keeps under the mouse") {
  for (const Projection projection : {Projection::perspective, Projection::parallel}) {
    const OrbitCamera camera = looking(-0.7, 0.5, projection);
    PlaneDrag drag = kAcross;
    const glm::dvec2 start = *camera.screen_of(drag.start_m, kView);
    drag.start_mouse = start + glm::dvec2(2, -1);  // beside its middle, and so it stays
    for (const glm::dvec2 by_px : {glm::dvec2(40, 0), glm::dvec2(-90, 30), glm::dvec2(5, -120)}) {
      const glm::dvec2 by_m = dragged_in_plane_m(drag, drag.start_mouse + by_px, camera, kView);
      const glm::dvec3 there_m = drag.start_m + by_m.x * drag.axes[0] + by_m.y * drag.axes[1];
      CHECK(glm::distance(*camera.screen_of(there_m, kView), start + by_px) < 1e-6);
    }
    CHECK(dragged_in_plane_m(drag, drag.start_mouse, camera, kView) == glm::dvec2(0));
  }
}

TEST_CASE("seen along its plane a point moves along the axis that can be seen") {
  PlaneDrag drag = kAcross;
  const OrbitCamera from_above = looking(0, std::numbers::pi / 2, Projection::parallel);  // X up, Y to the right
  drag.start_mouse = *from_above.screen_of(drag.start_m, kView);
  const double px_per_m = from_above.pixels_per_metre(drag.start_m, kView);
  const glm::dvec2 sideways = dragged_in_plane_m(drag, drag.start_mouse + glm::dvec2(30, 17), from_above, kView);
  CHECK(sideways.x == doctest::Approx(30 / px_per_m));
  CHECK(sideways.y == 0);
  const OrbitCamera from_the_side = looking(std::numbers::pi / 2, 0, Projection::perspective);  // along Y
  drag.start_mouse = *from_the_side.screen_of(drag.start_m, kView);
  const glm::dvec2 upwards = dragged_in_plane_m(drag, drag.start_mouse + glm::dvec2(0, -25), from_the_side, kView);
  CHECK(upwards.x == 0);
  CHECK(upwards.y > 0);
}

TEST_CASE("a mouse that is nowhere moves nothing, and beyond the horizon of the plane there is no answer") {
  PlaneDrag level{.start_m = {400, 20, -150}, .axes = {glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0)}};
  const OrbitCamera camera = looking(0, 0.3, Projection::perspective);
  level.start_mouse = *camera.screen_of(level.start_m, kView);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK(dragged_in_plane_m(level, {nan, 0}, camera, kView) == glm::dvec2(0));
  const glm::dvec2 above = dragged_in_plane_m(level, level.start_mouse - glm::dvec2(0, 5000), camera, kView);
  CHECK(std::isfinite(above.x));
  CHECK(std::isfinite(above.y));
}
