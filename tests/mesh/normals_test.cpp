// SPDX-License-Identifier: MIT

#include <doctest/doctest.h>
#include <algorithm>
#include <cmath>
#include <sstream>

#include "base/pose.h"
#include "mesh/mesh.h"
#include "mesh/written.h"
#include "support/test_data.h"

namespace sigs {
namespace {

// The axes of the file are the body's.
Result<Mesh> mesh_in_body_axes(const std::string& text) {
  return test::mesh_of(text, {.forward = "+x", .up = "-z"});
}

// A sphere of radius 1 cut along parallels and meridians, without normals.
std::string sphere_obj(int parallels, int meridians) {
  std::ostringstream text;
  text.precision(9);
  for (int i = 0; i <= parallels; ++i)
    for (int j = 0; j < meridians; ++j) {
      const double polar = M_PI * i / parallels;
      const double around = 2 * M_PI * j / meridians;
      // The poles are exact, so that the corners which meet there are at the very same place.
      const double ring = i == 0 || i == parallels ? 0 : std::sin(polar);
      text << "v " << ring * std::cos(around) << " " << ring * std::sin(around) << " " << std::cos(polar) << "\n";
    }
  for (int i = 0; i < parallels; ++i)
    for (int j = 0; j < meridians; ++j) {
      const int here = i * meridians + j + 1;
      const int next = i * meridians + (j + 1) % meridians + 1;
      text << "f " << here << " " << here + meridians << " " << next + meridians << " " << next << "\n";
    }
  return text.str();
}

double largest_angle_to_radius_deg(const Mesh& mesh) {
  double largest = 0;
  for (const Vertex& vertex : mesh.vertices) {
    const double cosine = glm::dot(glm::normalize(glm::dvec3(vertex.position_m)), glm::dvec3(vertex.normal));
    largest = std::max(largest, deg_of_rad(std::acos(std::clamp(cosine, -1.0, 1.0))));
  }
  return largest;
}

}  // namespace

TEST_CASE("averaged normals of a sphere point along its radius") {
  const Result<Mesh> mesh = mesh_in_body_axes(sphere_obj(48, 96));
  REQUIRE(mesh);
  // Faces are 3.75 degrees wide; weighting by angle leaves an error of second order of that, far below a tenth of it.
  CHECK(largest_angle_to_radius_deg(*mesh) < 0.3);
  for (const Vertex& vertex : mesh->vertices) CHECK(glm::length(vertex.normal) == doctest::Approx(1).epsilon(1e-6));
}

TEST_CASE("each vertex of a smooth sphere exists once") {
  const Result<Mesh> mesh = mesh_in_body_axes(sphere_obj(8, 16));
  REQUIRE(mesh);
  CHECK(mesh->vertices.size() == 7 * 16 + 2);
}

TEST_CASE("edges of a cube stay sharp") {
  const Result<Mesh> mesh = mesh_in_body_axes(test::box_obj());
  REQUIRE(mesh);
  for (const Vertex& vertex : mesh->vertices) {
    const glm::vec3 size = glm::abs(vertex.normal);
    CHECK(std::max({size.x, size.y, size.z}) == doctest::Approx(1).epsilon(1e-6));
  }
}

TEST_CASE("an edge between faces is smooth below sixty degrees and sharp above") {
  for (const double fold_deg : {20.0, 59.0, 61.0, 90.0}) {
    CAPTURE(fold_deg);
    const double slope = rad_of_deg(fold_deg / 2);
    std::ostringstream text;
    text.precision(9);
    text << "v 0 0 0\nv 1 0 0\nv 0 " << std::cos(slope) << " " << -std::sin(slope) << "\nv 0 " << -std::cos(slope)
         << " " << -std::sin(slope) << "\nf 1 2 3\nf 1 4 2\n";
    const Result<Mesh> mesh = mesh_in_body_axes(text.str());
    REQUIRE(mesh);
    const bool is_smooth = fold_deg < 60;
    CHECK(mesh->vertices.size() == (is_smooth ? 4 : 6));
  }
}

TEST_CASE("the file's own normals are kept and normalized") {
  const Result<Mesh> mesh = mesh_in_body_axes("v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 3 4\nf 1//1 2//1 3//1\n");
  REQUIRE(mesh);
  for (const Vertex& vertex : mesh->vertices) CHECK(glm::distance(vertex.normal, glm::vec3{0, 0.6F, 0.8F}) < 1e-6F);
}

TEST_CASE("normals without length or with NaN are computed anew") {
  for (const char* bad : {"vn 0 0 0", "vn nan nan nan"}) {
    const Result<Mesh> mesh =
        mesh_in_body_axes("v 0 0 0\nv 1 0 0\nv 0 1 0\n" + std::string(bad) + "\nf 1//1 2//1 3//1\n");
    REQUIRE(mesh);
    for (const Vertex& vertex : mesh->vertices) CHECK(glm::distance(vertex.normal, glm::vec3{0, 0, 1}) < 1e-6F);
  }
}

TEST_CASE("faces wound against their own normals are reversed") {
  const Result<Mesh> mesh = mesh_in_body_axes("v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 -1\nf 1//1 2//1 3//1\n");
  REQUIRE(mesh);
  const auto p = [&](std::size_t i) { return mesh->vertices[mesh->indices[i]].position_m; };
  CHECK(glm::cross(p(1) - p(0), p(2) - p(0)).z < 0);
}

}  // namespace sigs
