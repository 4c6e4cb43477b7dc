// SPDX-License-Identifier: MIT
#include "editor/geometry/ground_grid.h"

#include <doctest/doctest.h>

#include <cmath>

#include "tests/editor/geometry/cameras.h"

namespace sigs::editor {

TEST_CASE("the grid is on the ground, on round metres, and never more than 200 lines") {
  for (OrbitCamera camera : test::example_cameras())
    for (const double target_z_m : {0.0, -150.0, 1e7}) {
      camera.target_m.z = target_z_m;
      const GroundGrid grid = ground_grid(camera, test::kRect);
      CHECK(grid.lines.size() <= 200);
      CHECK(grid.lines.size() > 20);
      for (const GridLine& line : grid.lines) {
        CHECK((line.ends_m[0].z == 0 && line.ends_m[1].z == 0));
        CHECK(std::abs(std::remainder(line.at_m, grid.step_m)) < 1e-6 * grid.step_m);
        CHECK((line.is_of_x ? line.ends_m[0].x : line.ends_m[0].y) == line.at_m);
        const double decade = std::pow(10.0, std::floor(std::log10(grid.step_m) + 1e-9));
        const double bold_m = std::lround(grid.step_m / decade) == 5 ? 50 * decade : 10 * decade;
        CHECK(line.bold == (std::abs(std::remainder(line.at_m, bold_m)) < 1e-6 * bold_m));
      }
    }
}

TEST_CASE("from above, grid lines are 40 to 100 pixels apart and cover the screen") {
  for (double distance_m = 5; distance_m < 1e6; distance_m *= 1.7) {
    const OrbitCamera camera{.distance_m = distance_m, .elevation_rad = 1.5707963};
    const GroundGrid grid = ground_grid(camera, test::kRect);
    const double apart_px = grid.step_m * camera.pixels_per_metre({0, 0, 0}, test::kRect);
    CHECK(apart_px >= 40 * (1 - 1e-9));
    CHECK(apart_px <= 100 * (1 + 1e-9));
    const double reach_px = 49 * apart_px;
    CHECK(reach_px > glm::length(test::kRect.size()) / 2);
  }
}

TEST_CASE("distances are written in metres and kilometres") {
  CHECK(round_distance_text(0) == "0");
  CHECK(round_distance_text(-250) == "-250 m");
  CHECK(round_distance_text(0.05) == "0.05 m");
  CHECK(round_distance_text(1500) == "1.5 km");
}

}  // namespace sigs::editor
