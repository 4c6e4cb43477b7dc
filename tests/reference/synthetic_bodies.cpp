// SPDX-License-Identifier: MIT
#include "reference/synthetic_bodies.h"

#include <cmath>
#include <numbers>

namespace sigs::truth {
namespace {

std::uint32_t count_of(const std::vector<Vertex>& vertices) {
  return static_cast<std::uint32_t>(vertices.size());
}

// A grid of rows x columns + 1 vertices that begins at vertex `first`, as one part.
void add_grid(Mesh& mesh, std::uint32_t first, std::uint32_t rows, std::uint32_t columns) {
  const auto start = static_cast<std::uint32_t>(mesh.indices.size());
  for (std::uint32_t j = 0; j + 1 < rows; ++j)
    for (std::uint32_t i = 0; i < columns; ++i) {
      const std::uint32_t a = first + j * (columns + 1) + i;
      const std::uint32_t b = a + columns + 1;
      mesh.indices.insert(mesh.indices.end(), {a, a + 1, b, b, a + 1, b + 1});
    }
  mesh.parts.push_back({0, start, static_cast<std::uint32_t>(mesh.indices.size()) - start});
}

}  // namespace

Material painted(const glm::vec3& diffuse, float opacity) {
  return {.name = "paint", .diffuse = diffuse, .opacity = opacity};
}

void add_square(Mesh& mesh, const Material& material, double x_m, const glm::dvec2& middle_m, double side_m) {
  const std::uint32_t first = count_of(mesh.vertices);
  for (const glm::dvec2 corner : {glm::dvec2{0, 0}, glm::dvec2{1, 0}, glm::dvec2{0, 1}, glm::dvec2{1, 1}}) {
    const glm::dvec2 p = middle_m + (corner - 0.5) * side_m;
    mesh.vertices.push_back({{x_m, p.x, p.y}, {-1, 0, 0}, {corner.x, 1 - corner.y}});
  }
  const auto start = static_cast<std::uint32_t>(mesh.indices.size());
  // Counter-clockwise seen from -X, where Y runs right and Z down.
  mesh.indices.insert(mesh.indices.end(), {first, first + 2, first + 1, first + 1, first + 2, first + 3});
  mesh.parts.push_back({static_cast<int>(mesh.materials.size()), start, 6});
  mesh.materials.push_back(material);
}

Mesh square(const Material& material, double side_m) {
  Mesh mesh;
  add_square(mesh, material, 0, {0, 0}, side_m);
  return mesh;
}

Mesh sphere(double radius_m) {
  constexpr int kRings = 100;
  constexpr int kSpokes = 200;
  Mesh mesh{.materials = {painted({1, 1, 1})}};
  for (int ring = 0; ring <= kRings; ++ring)
    for (int spoke = 0; spoke <= kSpokes; ++spoke) {
      const double theta = std::numbers::pi * ring / kRings;
      const double phi = 2 * std::numbers::pi * spoke / kSpokes;
      const glm::dvec3 out(std::cos(theta), std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi));
      mesh.vertices.push_back({out * radius_m, out, {0, 0}});
    }
  add_grid(mesh, 0, kRings + 1, kSpokes);
  return mesh;
}

Mesh band(double radius_m, double first_x_m, double last_x_m) {
  constexpr int kSpokes = 720;
  Mesh mesh{.materials = {painted({1, 1, 1})}};
  for (const double x_m : {first_x_m, last_x_m})
    for (int spoke = 0; spoke <= kSpokes; ++spoke) {
      const double phi = 2 * std::numbers::pi * spoke / kSpokes;
      const glm::dvec3 out(0, std::cos(phi), std::sin(phi));
      mesh.vertices.push_back({radius_m * out + glm::dvec3(x_m, 0, 0), -out, {0, 0}});
    }
  add_grid(mesh, 0, 2, kSpokes);
  return mesh;
}

Setup setup_for(const Mesh& mesh, const glm::dvec3& p_in_camera_m, double focal_px, cv::Size size_px) {
  Setup setup{.mesh = &mesh, .light_in_camera = {-1e9, 0, 0}, .size_px = size_px};
  setup.camera_from_body.translation_m = p_in_camera_m;
  setup.lens = {.fx = focal_px, .fy = focal_px, .cx = (size_px.width - 1) / 2.0, .cy = (size_px.height - 1) / 2.0};
  return setup;
}

}  // namespace sigs::truth
