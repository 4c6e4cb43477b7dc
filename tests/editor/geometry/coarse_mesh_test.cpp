// SPDX-License-Identifier: MIT
#include "editor/geometry/coarse_mesh.h"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

namespace sigs::editor {
namespace {

// A ball of 10 m, red in front and green behind.
Mesh ball(int rings, int spokes) {
  Mesh mesh{.low_m = glm::vec3{-10}, .high_m = glm::vec3{10}, .radius_m = 10};
  mesh.materials = {{.name = "red", .diffuse = {1, 0, 0}}, {.name = "green", .diffuse = {0, 1, 0}}};
  const auto at = [&](int ring, int spoke) {
    const double polar = std::numbers::pi * ring / rings;
    const double turn = 2 * std::numbers::pi * (spoke % spokes) / spokes;
    return glm::vec3(10 * std::cos(polar), 10 * std::sin(polar) * std::cos(turn),
                     10 * std::sin(polar) * std::sin(turn));
  };
  for (int half = 0; half < 2; ++half) {
    const auto first = static_cast<std::uint32_t>(mesh.indices.size());
    for (int ring = half * rings / 2; ring < (half + 1) * rings / 2; ++ring)
      for (int spoke = 0; spoke < spokes; ++spoke)
        for (const auto& [r, s] : {std::pair{0, 0}, {1, 0}, {1, 1}, {0, 0}, {1, 1}, {0, 1}}) {
          mesh.indices.push_back(static_cast<std::uint32_t>(mesh.vertices.size()));
          mesh.vertices.push_back({at(ring + r, spoke + s), {1, 0, 0}, {0, 0}});
        }
    mesh.parts.push_back({half, first, static_cast<std::uint32_t>(mesh.indices.size()) - first});
  }
  return mesh;
}

}  // namespace

TEST_CASE("a simplified ball has few faces that face outwards, in its colours") {
  const Mesh mesh = ball(60, 80);
  for (const int maximum : {60, 300, 700}) {
    const CoarseMesh coarse_ball = coarse(mesh, maximum);
    CHECK(static_cast<int>(coarse_ball.faces.size()) <= maximum);
    CHECK(static_cast<int>(coarse_ball.faces.size()) > maximum / 4);
    for (const glm::vec3& p : coarse_ball.points_m) CHECK(glm::length(p) == doctest::Approx(10).epsilon(0.25));
    for (const auto& face : coarse_ball.faces) {
      glm::vec3 middle{0, 0, 0};
      for (const int corner : face.corners) middle += coarse_ball.points_m[corner] / 3.0F;
      CHECK(glm::length(face.normal) == doctest::Approx(1));
      CHECK(glm::dot(face.normal, middle) > 0);
      if (middle.x > 5) CHECK(face.color.r > 0.99F);
      if (middle.x < -5) CHECK(face.color.g > 0.99F);
    }
  }
}

TEST_CASE("an empty mesh has no faces, and transparent parts are left out") {
  CHECK(coarse(Mesh{}).faces.empty());
  CHECK(coarse(ball(6, 8), 0).faces.empty());
  Mesh glassy = ball(20, 20);
  glassy.materials[0].opacity = 0.2F;
  const CoarseMesh half = coarse(glassy);
  CHECK_FALSE(half.faces.empty());
  for (const auto& face : half.faces) CHECK(face.color.r < 0.01F);
}

TEST_CASE("a texture counts with its mean colour") {
  Mesh mesh = ball(6, 8);
  for (Material& material : mesh.materials) {
    material.diffuse = {1, 1, 1};
    material.texture = cv::Mat(4, 4, CV_8UC4, cv::Scalar(51, 102, 204, 255));
  }
  const CoarseMesh painted = coarse(mesh);
  REQUIRE_FALSE(painted.faces.empty());
  for (const auto& face : painted.faces) CHECK(glm::distance(face.color, glm::vec3(0.2F, 0.4F, 0.8F)) < 1e-3F);
}

}  // namespace sigs::editor
