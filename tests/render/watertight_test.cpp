// SPDX-License-Identifier: MIT

#include <doctest/doctest.h>
#include <algorithm>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "render/draw_list.h"
#include "render/scenes.h"

namespace sigs {

using namespace test;

namespace {

bool all_are(const Mesh& mesh, CullFace side) {
  const std::vector<CullFace> sides = cull_faces_of(mesh, surfaces_of(mesh));
  REQUIRE(sides.size() == mesh.indices.size() / 3);
  return std::all_of(sides.begin(), sides.end(), [side](CullFace each) { return each == side; });
}

Mesh turned_inside_out(Mesh mesh) {
  for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) std::swap(mesh.indices[i], mesh.indices[i + 1]);
  return mesh;
}

Mesh without_last_triangle(Mesh mesh) {
  mesh.indices.resize(mesh.indices.size() - 3);
  mesh.parts.back().index_count -= 3;
  return mesh;
}

// An invisible triangle on one of the edges makes the body not watertight.
Mesh with_fin_inside(Mesh mesh) {
  const auto tip = static_cast<std::uint32_t>(mesh.vertices.size());
  mesh.vertices.push_back({{0.5F, 0, 0}, {1, 0, 0}, {0, 0}});
  mesh.parts.push_back({0, static_cast<std::uint32_t>(mesh.indices.size()), 3});
  mesh.indices.insert(mesh.indices.end(), {mesh.indices[0], mesh.indices[1], tip});
  return mesh;
}

}  // namespace

TEST_CASE("the inner sides of a box are culled whichever way its triangles are wound") {
  const Mesh mesh = box({1, 2, 3}, kWhite);
  CHECK(all_are(mesh, CullFace::back));
  CHECK(all_are(turned_inside_out(mesh), CullFace::front));
  CHECK(all_are(box({1, 2, 0.001F}, kWhite), CullFace::back));
}

TEST_CASE("a box far from the origin is as watertight as one around it") {
  Mesh mesh = box({1, 2, 3}, kWhite);
  for (Vertex& vertex : mesh.vertices) vertex.position_m += glm::vec3{4096, -4096, 1024};
  CHECK(all_are(mesh, CullFace::back));
}

TEST_CASE("surfaces with a hole, with glass or without volume are not culled") {
  CHECK(all_are(without_last_triangle(box({1, 2, 3}, kWhite)), CullFace::none));
  CHECK(all_are(facing_quad({-1, -1}, {1, 1}, kWhite), CullFace::none));
  CHECK(all_are(box({1, 2, 3}, paint({1, 1, 1}, 0.5F)), CullFace::none));
  CHECK(all_are(box({1, 2, 0}, kWhite), CullFace::none));  // a sheet with two sides
  CHECK(cull_faces_of(Mesh{}, {}).empty());
}

TEST_CASE("a watertight part is culled beside an open one") {
  Mesh mesh = box({1, 1, 1}, kWhite);
  const auto start = mesh.indices.size() / 3;
  add_quad(mesh, {5, -1, 1}, {0, 2, 0}, {0, 0, -2}, 0);
  const std::vector<CullFace> sides = cull_faces_of(mesh, surfaces_of(mesh));
  REQUIRE(sides.size() == start + 2);
  for (std::size_t i = 0; i < sides.size(); ++i) CHECK(sides[i] == (i < start ? CullFace::back : CullFace::none));
}

TEST_CASE("a body looks the same with and without culling") {
  for (const Mesh& watertight : {box({1, 2, 0.5F}, kWhite), turned_inside_out(box({1, 2, 0.5F}, kWhite))}) {
    const Mesh open = with_fin_inside(watertight);
    REQUIRE(all_are(open, CullFace::none));
    for (const double turn_rad : {0.3, 1.1, 2.0, 4.4}) {
      Pose<frame::Camera, frame::Body> pose = at({12, 0.3, -0.2});
      pose.rotation = glm::angleAxis(turn_rad, glm::normalize(glm::dvec3{1, 2, 3}));
      const Light light{.p_in_camera = {0, 30, -20}};
      const Layer left_out = drawn(watertight, pose, light, view_of({60, 60}, 120));
      const Layer all_drawn = drawn(open, pose, light, view_of({60, 60}, 120));
      CHECK(same_bytes(left_out.coverage, all_drawn.coverage));
      // Where a near and a far side meet in a rim, their depths are equal and either may be in front.
      cv::Mat inside;
      cv::erode(left_out.coverage == 1.0F, inside, cv::Mat());
      REQUIRE(cv::countNonZero(inside) > 100);
      cv::Mat differs = cv::Mat(left_out.color.reshape(1) != all_drawn.color.reshape(1)).reshape(1, 60 * 60);
      cv::reduce(differs, differs, 1, cv::REDUCE_MAX);
      CHECK(cv::countNonZero(differs.reshape(1, 60) & inside) == 0);
    }
  }
}

}  // namespace sigs
