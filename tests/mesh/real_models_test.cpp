// SPDX-License-Identifier: MIT

#include <doctest/doctest.h>
#include <algorithm>
#include <cmath>

#include "mesh/geometry.h"
#include "mesh/mesh.h"
#include "support/test_data.h"

using namespace sigs;

TEST_CASE("real aircraft have the size and the triangles that their catalogue states") {
  if (!test::has_real_data()) return;
  struct Aircraft {
    const char* file;
    std::size_t triangles;
    double length_m, height_m, span_m;
  };
  const Aircraft all[] = {{"boeing737-300/boeing737-300.obj", 5507, 33.3, 11.2, 28.4},
                          {"cessna172p-hires/cessna172p-hires.obj", 96367, 8.2, 2.5, 11.3},
                          {"glider-centrair101/glider-centrair101.obj", 1058, 6.8, 1.6, 15.0},
                          {"helicopter-dauphin/helicopter-dauphin.obj", 1740, 14.2, 4.0, 11.9}};
  for (const Aircraft& aircraft : all) {
    CAPTURE(aircraft.file);
    const Result<Mesh> mesh = read_obj(test::real_data() / "models" / aircraft.file, {.forward = "-x", .up = "+y"});
    REQUIRE(mesh);
    const glm::dvec3 size = mesh->high_m - mesh->low_m;
    // Of the catalogue's one decimal, and 1 % for the larger ones.
    const auto is_near = [](double found, double told) { return std::abs(found - told) < std::max(0.05, 0.01 * told); };
    CHECK(is_near(size.x, aircraft.length_m));
    CHECK(is_near(size.y, aircraft.span_m));
    CHECK(is_near(size.z, aircraft.height_m));
    // The files hold up to 1 % of faces without area (the same point three times over) or without opacity.
    CHECK(mesh->indices.size() / 3 <= aircraft.triangles);
    CHECK(static_cast<double>(mesh->indices.size() / 3) >= 0.99 * static_cast<double>(aircraft.triangles));
    for (const Material& material : mesh->materials) CHECK(material.opacity >= 0);
    for (const Vertex& vertex : mesh->vertices) REQUIRE(std::abs(glm::length(vertex.normal) - 1) < 1e-4);
  }
}

TEST_CASE("the real light aircraft has glass and no hot spots") {
  if (!test::has_real_data()) return;
  const Result<Mesh> mesh =
      read_obj(test::real_data() / "models/cessna172p-hires/cessna172p-hires.obj", {.forward = "-x", .up = "+y"});
  REQUIRE(mesh);
  int glass = 0;
  for (const MeshPart& part : mesh->parts) {
    const Material& material = mesh->materials[part.material];
    CHECK(material.opacity > 0);
    if (material.name == "material_17") glass = static_cast<int>(part.index_count) / 3;
    if (material.name == "material_17") CHECK(material.opacity == 0.2F);
  }
  CHECK(glass >= 400);  // windscreen and side windows: 317 + 60 + 60, less what has no area
}

TEST_CASE("a drone of unknown unit without its MTL gets its length and a warning") {
  if (!test::has_real_data()) return;
  const Result<Mesh> mesh = read_obj(test::real_data() / "models/quadcopter-ratisbon/drone.obj",
                                     {.forward = "-z", .up = "+y", .length_m = 0.6, .anchor_at_bounds = true});
  REQUIRE(mesh);
  CHECK(mesh->indices.size() == 3 * 308);
  CHECK(mesh->high_m.x == doctest::Approx(0.3).epsilon(1e-5));  // float
  REQUIRE(mesh->warnings.size() == 1);
  CHECK(mesh->warnings[0].text().find("drone.mtl") != std::string::npos);
}

namespace {

// Reads with the axes in which nothing is changed but names, and says what the shape tells.
std::string shape_text(const std::filesystem::path& file, const ModelAxes& axes = {}) {
  const Result<Mesh> mesh = read_obj(file, axes);
  REQUIRE(mesh);
  const ModelShape shape = shape_of(*mesh);
  return file_axis(shape.nose, axes) + (shape.nose_is_sure ? "! " : "? ") + file_axis(shape.top, axes) +
         (shape.top_is_sure ? "!" : "?");
}

}  // namespace

TEST_CASE("the nose and the top of aircraft are found in their shape, whatever axes they were read with") {
  for (const char* const name : {"light-aircraft", "airliner"}) {
    CAPTURE(name);
    const auto file = test::source_dir() / "assets/models" / name / (std::string(name) + ".obj");
    for (const auto& [forward, up] : {std::pair{"+x", "+z"}, {"-x", "+y"}, {"+y", "-x"}, {"-z", "-y"}})
      CHECK(shape_text(file, {.forward = forward, .up = up}) == "+x! +z!");
  }
}

TEST_CASE("models of others, with the nose along -x and the top along +y, are recognised") {
  if (!test::has_real_data()) return;
  for (const char* const name : {"boeing737-300", "cessna172p-hires", "glider-centrair101", "helicopter-dauphin"}) {
    CAPTURE(name);
    CHECK(shape_text(test::real_data() / "models" / name / (std::string(name) + ".obj")) == "-x! +y!");
  }
}
TEST_CASE("a quadcopter has no tail that would tell its nose") {
  const auto file = test::source_dir() / "assets/models/quadcopter/quadcopter.obj";
  const Result<Mesh> mesh = read_obj(file);
  REQUIRE(mesh);
  CHECK_FALSE(shape_of(*mesh).nose_is_sure);
}
