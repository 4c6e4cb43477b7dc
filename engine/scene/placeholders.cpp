// SPDX-License-Identifier: MIT
#include "scene/placeholders.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>
#include <vector>

#include "base/ensure.h"
#include "project/fields.h"

namespace sigs {

namespace {

constexpr double kLengthOverWidth = 30;                // of the cross' beams
constexpr glm::vec3 kMagentaRed{0.95F, 0.15F, 0.55F};  // display code values

// One side of a beam, two triangles: corner, then its two edges, counter-clockwise seen from outside.
void add_side(Mesh& mesh, const glm::vec3& corner, const glm::vec3& u, const glm::vec3& v) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  const glm::vec3 normal = glm::normalize(glm::cross(u, v));
  for (const glm::vec3& position : {corner, corner + u, corner + u + v, corner + v})
    mesh.vertices.push_back({position, normal, {0, 0}});
  for (const std::uint32_t index : {0U, 1U, 2U, 0U, 2U, 3U}) mesh.indices.push_back(first + index);
}

void add_beam(Mesh& mesh, const glm::vec3& half_m) {
  for (int axis = 0; axis < 3; ++axis) {
    glm::vec3 u(0);
    glm::vec3 v(0);
    glm::vec3 out(0);
    out[axis] = half_m[axis];
    u[(axis + 1) % 3] = 2 * half_m[(axis + 1) % 3];
    v[(axis + 2) % 3] = 2 * half_m[(axis + 2) % 3];
    const glm::vec3 middle = 0.5F * (u + v);
    add_side(mesh, out - middle, u, v);
    add_side(mesh, -out - middle, v, u);
  }
}

void sanitize(const Field& field, double& number, double plain) {
  number = std::isfinite(number) ? std::clamp(number, field.minimum, field.maximum) : plain;
}

void sanitize(const Field& field, int& number) {
  // Compared as doubles: a field's ends need not be whole numbers that an int holds.
  if (number < field.minimum) number = static_cast<int>(field.minimum);
  if (number > field.maximum) number = static_cast<int>(field.maximum);
}

// plain: the same field of a project of defaults.
void sanitize(const Field& field, const Field& plain) {
  if (auto* const number = std::get_if<double*>(&field.value))
    sanitize(field, **number, *std::get<double*>(plain.value));
  if (auto* const number = std::get_if<int*>(&field.value)) sanitize(field, **number);
  if (auto* const number = std::get_if<std::optional<int>*>(&field.value); number && **number)
    sanitize(field, ***number);
  if (auto* const number = std::get_if<std::optional<double>*>(&field.value); number && **number) {
    if (std::isfinite(***number)) {
      sanitize(field, ***number, 0);
    } else {
      **number = std::nullopt;
    }
  }
  if (auto* const vector = std::get_if<glm::dvec3*>(&field.value))
    for (int i = 0; i < 3; ++i) sanitize(field, (**vector)[i], (*std::get<glm::dvec3*>(plain.value))[i]);
}

// Defaults in everything, with as many intruders and waypoints.
Project plain_like(const Project& project) {
  Project plain;
  for (const IntruderSettings& intruder : project.intruders)
    plain.intruders.emplace_back().trajectory.waypoints.resize(intruder.trajectory.waypoints.size());
  return plain;
}

}  // namespace

Mesh cross_mesh(double length_m) {
  ENSURE(length_m > 0 && std::isfinite(length_m));
  Mesh mesh;
  const auto half_m = static_cast<float>(length_m / 2);
  for (int axis = 0; axis < 3; ++axis) {
    glm::vec3 half(half_m / static_cast<float>(kLengthOverWidth));
    half[axis] = half_m;
    add_beam(mesh, half);
  }
  mesh.parts = {{.material = 0, .first_index = 0, .index_count = static_cast<std::uint32_t>(mesh.indices.size())}};
  mesh.materials = {{.name = "stand-in", .diffuse = kMagentaRed}};
  mesh.low_m = glm::vec3(-half_m);
  mesh.high_m = glm::vec3(half_m);
  for (const Vertex& vertex : mesh.vertices) mesh.radius_m = std::max(mesh.radius_m, glm::length(vertex.position_m));
  return mesh;
}

Camera placeholder_camera(cv::Size size_px) {
  const double focal_px = 0.5 * size_px.width / std::tan(std::numbers::pi / 6);
  return {
      *Lens::make({.fx = focal_px, .fy = focal_px, .cx = (size_px.width - 1) / 2.0, .cy = (size_px.height - 1) / 2.0}),
      size_px};
}

Project sanitized(Project project) {
  Project plain = plain_like(project);
  const std::vector<Field> fields = fields_of(project);
  const std::vector<Field> plain_fields = fields_of(plain);
  ENSURE(fields.size() == plain_fields.size());
  for (std::size_t i = 0; i < fields.size(); ++i) sanitize(fields[i], plain_fields[i]);
  return project;
}

}  // namespace sigs
