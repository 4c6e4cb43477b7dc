// SPDX-License-Identifier: MIT
#include "render/level_of_detail.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "mesh/deviation.h"
#include "render/scenes.h"
#include "render/vertex_material.h"

namespace sigs {

using namespace test;

namespace {

// A ball of 1 m radius in rings, the upper half of one material, the lower of another.
Mesh ball(int rings) {
  Mesh mesh;
  mesh.materials = {paint({0.8F, 0.2F, 0.2F}), paint({0.2F, 0.2F, 0.8F})};
  const int around = 2 * rings;
  const auto add = [&](int j, int i) {
    const double polar = M_PI * j / rings;
    const double turn = 2 * M_PI * (i % around) / around;
    const double radius_m = j == 0 || j == rings ? 0 : std::sin(polar);  // poles are points
    const glm::vec3 p(radius_m * std::cos(turn), radius_m * std::sin(turn), -std::cos(polar));
    mesh.vertices.push_back({p, p, {0, 0}});
  };
  for (int j = 0; j <= rings; ++j)
    for (int i = 0; i < around; ++i) add(j, i);
  const auto at = [&](int j, int i) { return static_cast<std::uint32_t>(j * around + i % around); };
  for (const int half : {0, 1}) {
    const auto start = static_cast<std::uint32_t>(mesh.indices.size());
    for (int j = half * rings / 2; j < (half + 1) * rings / 2; ++j)
      for (int i = 0; i < around; ++i) {
        if (j > 0) mesh.indices.insert(mesh.indices.end(), {at(j, i), at(j, i + 1), at(j + 1, i + 1)});
        if (j < rings - 1) mesh.indices.insert(mesh.indices.end(), {at(j, i), at(j + 1, i + 1), at(j + 1, i)});
      }
    mesh.parts.push_back({half, start, static_cast<std::uint32_t>(mesh.indices.size()) - start});
  }
  return measured(std::move(mesh));
}

DrawList whole_list(const Mesh& split) {
  return solid_list(split, surfaces_of(split), texture_numbers(split));
}

// How far any triangle reaches into the sphere, on a grid over each.
double deepest_m(const Mesh& mesh, const std::vector<std::uint32_t>& indices) {
  double deepest = 0;
  for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
    const auto p = [&](std::size_t k) { return glm::dvec3(mesh.vertices[indices[i + k]].position_m); };
    for (int s = 0; s <= 8; ++s)
      for (int t = 0; s + t <= 8; ++t)
        deepest =
            std::max(deepest, 1 - glm::length((p(0) * double(s) + p(1) * double(t) + p(2) * double(8 - s - t)) / 8.0));
  }
  return deepest;
}

}  // namespace

TEST_CASE("a ball of fewer triangles lies within what was allowed and has no holes") {
  const Mesh mesh = split_by_material(ball(48));
  const DrawList whole = whole_list(mesh);
  const double flat_m = deepest_m(mesh, whole.indices);
  for (const int step : {-4, -6, -8}) {
    CAPTURE(step);
    const double allowed_m = std::ldexp(1.0, step);
    const DrawList detail = simplified_list(mesh.vertices, whole, step);
    CHECK(detail.indices.size() < 0.8 * double(whole.indices.size()));
    CHECK(deviation_m(mesh.vertices, whole.indices, detail.indices, false, 1) <= allowed_m);
    // The whole ball's own triangles lie within the sphere, too.
    CHECK(deepest_m(mesh, detail.indices) <= allowed_m + flat_m);
    Mesh fewer = mesh;
    fewer.indices = detail.indices;
    fewer.parts = {{0, 0, static_cast<std::uint32_t>(fewer.indices.size())}};
    for (const CullFace side : cull_faces_of(fewer, surfaces_of(fewer))) REQUIRE(side == CullFace::back);
  }
}

TEST_CASE("the same mesh has the same detail twice and no error allowed is the whole of it") {
  const Mesh mesh = split_by_material(ball(24));
  const DrawList whole = whole_list(mesh);
  CHECK(simplified_list(mesh.vertices, whole, -6).indices == simplified_list(mesh.vertices, whole, -6).indices);
  CHECK(simplified_list(mesh.vertices, whole, -40).indices.size() == whole.indices.size());
  CHECK_FALSE(step_for(0));
  CHECK_FALSE(step_for(-1));
  CHECK_FALSE(step_for(std::nan("")));
  CHECK_FALSE(step_for(std::numeric_limits<double>::infinity()));
  CHECK(step_for(0.25) == -2);
  CHECK(step_for(0.3) == -2);
}

TEST_CASE("a far ball is drawn with fewer triangles and its outline stays within a sample") {
  const Mesh mesh = ball(64);
  Renderer by = Renderer::create().value();
  const auto drawn_at = [&](double distance_m) {
    const RenderCounts before = by.counts();
    // 40 px across at any distance: the focal length goes with it.
    const Layer layer =
        by.draw(mesh, at({distance_m, 0, 0}), ambient_only(), view_of({64, 64}, 20 * distance_m)).value();
    CHECK(is_valid(layer));
    CHECK(cv::sum(layer.coverage)[0] == doctest::Approx(M_PI * 400).epsilon(0.015));  // a sagitta of 1/4 px at most
    return by.counts().triangles_drawn - before.triangles_drawn;
  };
  CHECK(drawn_at(1000) < 0.6 * double(mesh.indices.size() / 3));
  CHECK(by.counts().pixels_drawn == 64 * 64);
  CHECK(by.counts().draw_calls == 1);  // both materials, one call
  const std::int64_t uploaded = by.counts().bytes_uploaded;
  CHECK(uploaded > static_cast<std::int64_t>(mesh.vertices.size() * sizeof(Vertex)));
  drawn_at(1000);
  CHECK(by.counts().bytes_uploaded == uploaded);
}

TEST_CASE("glass of many materials is drawn with one call") {
  Mesh mesh;
  for (int i = 0; i < 20; ++i) {
    mesh.materials.push_back(paint({0.05F * float(i), 1, 0}, 0.2F));
    add_quad(mesh, {float(i), -1, 1}, {0, 2, 0}, {0, 0, -2}, i);
  }
  mesh = measured(std::move(mesh));
  Renderer by = Renderer::create().value();
  CHECK(is_valid(by.draw(mesh, at({60, 0, 0}), Light{}, view_of({16, 16}, 100)).value()));
  CHECK(by.counts().draw_calls == 1);
  CHECK(by.counts().triangles_drawn == 40);
}

TEST_CASE("a vertex that two materials share has the colour of each on its side") {
  Mesh mesh = facing_quad({-1, -1}, {1, 1}, paint({1, 0, 0}));
  mesh.materials.push_back(paint({0, 0, 1}));
  mesh.parts = {{0, 0, 3}, {1, 3, 3}};
  const Mesh split = split_by_material(mesh);
  CHECK(split.vertices.size() == 6);  // two of four are shared
  const Layer layer = drawn(mesh, at({10, 0, 0}), ambient_only(), view_of({32, 32}, 160));
  CHECK(layer.color.at<cv::Vec4f>(24, 24) == cv::Vec4f(1, 0, 0, 1));
  CHECK(layer.color.at<cv::Vec4f>(8, 8) == cv::Vec4f(0, 0, 1, 1));
}

}  // namespace sigs
