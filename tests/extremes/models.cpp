// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <cmath>
#include <cstdint>
#include <fstream>
#include <memory>
#include <numbers>

#include "extremes/validity.h"
#include "mesh/mesh.h"
#include "scene/model.h"

namespace sigs::test {
namespace {

// A sphere around the origin of 2 * rings * spokes triangles, those at the poles without area.
Mesh sphere(float radius_m, int rings, int spokes) {
  Mesh mesh;
  for (int ring = 0; ring <= rings; ++ring)
    for (int spoke = 0; spoke <= spokes; ++spoke) {
      const double theta = std::numbers::pi * ring / rings;
      const double phi = 2 * std::numbers::pi * (spoke % spokes) / spokes;
      const glm::vec3 out(
          glm::dvec3(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)));
      mesh.vertices.push_back({.position_m = radius_m * out, .normal = out, .uv = {0, 0}});
    }
  const auto row = static_cast<std::uint32_t>(spokes + 1);
  for (std::uint32_t ring = 0; ring < static_cast<std::uint32_t>(rings); ++ring)
    for (std::uint32_t spoke = 0; spoke + 1 < row; ++spoke) {
      const std::uint32_t a = ring * row + spoke;
      mesh.indices.insert(mesh.indices.end(), {a, a + row, a + 1, a + 1, a + row, a + row + 1});
    }
  mesh.parts = {{.material = 0, .first_index = 0, .index_count = static_cast<std::uint32_t>(mesh.indices.size())}};
  mesh.materials = {{.name = "paint"}};
  mesh.low_m = glm::vec3(-radius_m);
  mesh.high_m = glm::vec3(radius_m);
  mesh.radius_m = radius_m;
  return mesh;
}

// The scene's one intruder flies this instead.
void give_model(Scene& scene, Mesh mesh) {
  scene.models = {std::make_shared<const Model>(model_of(std::move(mesh)))};
  scene.intruders[0].model = scene.models.front().get();
}

}  // namespace

TEST_CASE("a sphere of a million triangles is rendered with its true area") {
  Scenario scenario;
  add_cube(scenario, 1, kEye_m + glm::dvec3(100, 0, 0));
  Scene scene = scenario.opened();
  give_model(scene, sphere(10, 500, 1000));
  REQUIRE(scene.models.front()->mesh.indices.size() == 3'000'000);
  const ValidFrame valid = valid_frame(scene, 1, even_frame(scenario.size_px(), 100));
  // Seen from 100 m the disc's edge is where the line of sight touches: tan(asin(10 / 100)).
  const double radius_px = Scenario::kFocal_px * 10 / std::sqrt(100.0 * 100 - 10.0 * 10);
  const IntruderTruth& truth = valid.composed.truth.intruders[0];
  REQUIRE(truth.amodal_box);
  CHECK(truth.amodal_box->width == doctest::Approx(2 * radius_px).epsilon(1e-3));
  CHECK(truth.amodal_box->height == doctest::Approx(2 * radius_px).epsilon(1e-3));
  CHECK(cv::sum(valid.layers[0].warped.coverage)[0] ==
        doctest::Approx(std::numbers::pi * radius_px * radius_px).epsilon(0.005));
  CHECK(truth.visible_fraction == doctest::Approx(1).epsilon(1e-3));
}

TEST_CASE("a single triangle is rendered with its true area, from both sides") {
  for (const bool faces_us : {true, false})
    for (const double supersampling : {1.0, 2.0}) {
      CAPTURE(faces_us);
      Scenario scenario;
      std::ofstream(scenario.path("triangle.obj")) << "v 0 0 0\nv 0 12 0\nv 0 0 -8\n"
                                                   << (faces_us ? "f 1 2 3\n" : "f 1 3 2\n");
      scenario.add("triangle.obj", kEye_m + glm::dvec3(60, -5, 3));
      scenario.project.compositing.supersampling = static_cast<int>(supersampling);
      const ValidFrame valid = valid_frame(scenario.opened(), 1, even_frame(scenario.size_px(), 100));
      // 60 by 40 px, and half of that.
      CHECK(cv::sum(valid.layers[0].warped.coverage)[0] == doctest::Approx(1200).epsilon(0.01));
      const Box& box = *valid.composed.truth.intruders[0].amodal_box;
      CHECK(box.width == doctest::Approx(60).epsilon(1e-6));
      CHECK(box.height == doctest::Approx(40).epsilon(1e-6));
    }
}

TEST_CASE("a single triangle seen edge on covers nothing and causes no error") {
  Scenario scenario;
  std::ofstream(scenario.path("triangle.obj")) << "v 0 0 0\nv 12 0 0\nv 0 12 0\nf 1 2 3\n";
  scenario.add("triangle.obj", kEye_m + glm::dvec3(60, 0, 0));  // flat in the plane of sight
  const ValidFrame valid = valid_frame(scenario.opened(), 1, even_frame(scenario.size_px(), 100));
  CHECK(valid.composed.truth.intruders[0].amodal_box->height == doctest::Approx(0));
  CHECK(opacity_px(valid.layers[0].occluded) < 60);  // a line of 60 px at most
}

TEST_CASE("models of a micrometre and of a thousand kilometres are valid from near and far") {
  for (const double scale : {1e-6, 1e6 / 12})
    for (const double distance_lengths : {0.6, 3.0, 1000.0}) {
      CAPTURE(scale);
      CAPTURE(distance_lengths);
      Scenario scenario({96, 72});
      scenario.project.compositing.supersampling = 1;
      add_aircraft(scenario, kEye_m + glm::dvec3(12 * scale * distance_lengths, 0, 0));
      if (length(scenario.project.intruders[0].trajectory.waypoints[0].position_m) > 9e7) continue;
      scenario.project.intruders[0].model.scale = scale;
      const ValidFrame valid = valid_frame(scenario.opened(), 1, even_frame(scenario.size_px(), 100));
      CHECK(valid.composed.truth.intruders[0].in_image);
    }
}

}  // namespace sigs::test
