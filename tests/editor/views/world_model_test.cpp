// SPDX-License-Identifier: MIT
#include "editor/views/world/model.h"

#include <doctest/doctest.h>

#include <numbers>

#include "../geometry/lenses.h"

using namespace sigs;
using namespace sigs::editor;

TEST_CASE("a pinhole's image has four corners on the plane a metre ahead") {
  const Camera camera{*Lens::make({LensModel::brown_conrady, 900, 800, 639.5, 479.5, {}}), {1280, 960}};
  const ImageBorder border = image_border(camera);
  REQUIRE(border.rays.size() == 4);
  CHECK(border.corners == std::vector<std::size_t>{0, 1, 2, 3});
  // (pixel - centre) / focal length, from the pixels' outer edges: 1280 / 2 / 900 and 960 / 2 / 800.
  const double right = 640.0 / 900;
  const double down = 480.0 / 800;
  const glm::dvec3 expected[] = {{1, -right, -down}, {1, right, -down}, {1, right, down}, {1, -right, down}};
  for (std::size_t i = 0; i < 4; ++i) CHECK(glm::distance(border.rays[i], expected[i]) < 1e-12);
}

TEST_CASE("the border's rays meet the image's edge through every lens that sees it") {
  for (const Camera& camera : editor::test::example_lenses()) {
    const ImageBorder border = image_border(camera);
    REQUIRE(border.corners.size() == 4);
    for (const glm::dvec3& ray : border.rays) {
      const std::optional<glm::dvec2> pixel = camera.lens.pixel(ray);
      REQUIRE(pixel.has_value());
      const double off_x = std::min(std::abs(pixel->x + 0.5), std::abs(pixel->x - 1279.5));
      const double off_y = std::min(std::abs(pixel->y + 0.5), std::abs(pixel->y - 959.5));
      CHECK(std::min(off_x, off_y) < 1e-3);  // the lens' own inverse stops at 1e-4 px
    }
  }
}

TEST_CASE("the camera flies along world X from where it starts, in its attitude") {
  Project project;
  project.camera.position_m = {5, 6, -7};
  project.camera.speed_mps = 22;
  project.camera.yaw_deg = 90;
  const CameraPose pose = camera_pose_at(project, 3);
  CHECK(glm::distance(pose.translation_m, glm::dvec3(71, 6, -7)) < 1e-12);
  CHECK(glm::distance(pose.rotation * glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0)) < 1e-12);  // right of world X
}
