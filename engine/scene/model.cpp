// SPDX-License-Identifier: MIT
#include "scene/model.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <limits>
#include <numbers>
#include <string_view>
#include <tuple>
#include <utility>

#include "base/ensure.h"
#include "base/text.h"

namespace sigs {

namespace {

constexpr double kGapsAlongDiagonal = 100;
constexpr int kDirections = 100;  // each used twice: with a plane and with a paraboloid

bool before(const glm::vec3& a, const glm::vec3& b) {
  return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
}

// Always from the same end, so that the triangles on both sides of an edge give the same points.
void add_between(glm::vec3 from, glm::vec3 to, double gap_m, std::vector<glm::vec3>& points) {
  if (before(to, from)) std::swap(from, to);
  const glm::dvec3 along = glm::dvec3(to) - glm::dvec3(from);
  const int steps = static_cast<int>(std::ceil(glm::length(along) / gap_m));
  for (int i = 1; i < steps; ++i) points.emplace_back(glm::dvec3(from) + along * (double(i) / steps));
}

// Evenly spread over the sphere: Fibonacci grid (Swinbank and Purser 2006, "Fibonacci grids").
glm::vec3 direction(int index) {
  const double z = 1 - (2 * index + 1.0) / kDirections;
  const double turn = index * std::numbers::pi * (3 - std::sqrt(5.0));
  const double r = std::sqrt(1 - z * z);
  return {r * std::cos(turn), r * std::sin(turn), z};
}

// Index of the point that is touched first by a paraboloid moving in from `direction`, its apex ahead; curvature: at
// the apex, 1/m; 0: a plane.
std::size_t first_touched(const std::vector<glm::vec3>& points, const glm::vec3& center, const glm::vec3& direction,
                          float curvature) {
  std::size_t best = 0;
  float farthest = -std::numeric_limits<float>::infinity();
  for (std::size_t i = 0; i < points.size(); ++i) {
    const glm::vec3 p = points[i] - center;
    const float along = glm::dot(p, direction);
    const float reached = along - 0.5F * curvature * (glm::dot(p, p) - along * along);
    if (reached > farthest) {
      farthest = reached;
      best = i;
    }
  }
  return best;
}

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

// Of the triangles that are of no rotor.
std::vector<std::uint32_t> indices_without_rotors(const Mesh& mesh) {
  std::vector<std::uint32_t> indices;
  for (const MeshPart& part : mesh.parts)
    if (!mesh.materials[static_cast<std::size_t>(part.material)].rotor)
      for (std::uint32_t i = 0; i < part.index_count; ++i) indices.push_back(mesh.indices[part.first_index + i]);
  return indices;
}

std::vector<glm::vec3> measuring_points(const Mesh& mesh, bool with_rotors = true) {
  std::vector<glm::vec3> points;
  const std::vector<std::uint32_t> indices = with_rotors ? mesh.indices : indices_without_rotors(mesh);
  points.reserve(mesh.vertices.size());
  if (with_rotors)
    for (const Vertex& vertex : mesh.vertices) points.push_back(vertex.position_m);
  else
    for (const std::uint32_t index : indices) points.push_back(mesh.vertices[index].position_m);
  const double gap_m = glm::length(glm::dvec3(mesh.high_m) - glm::dvec3(mesh.low_m)) / kGapsAlongDiagonal;
  for (std::size_t i = 0; gap_m > 0 && i + 2 < indices.size(); i += 3)
    for (std::size_t side = 0; side < 3; ++side)
      add_between(mesh.vertices[indices[i + side]].position_m, mesh.vertices[indices[i + (side + 1) % 3]].position_m,
                  gap_m, points);
  std::sort(points.begin(), points.end(), before);
  points.erase(std::unique(points.begin(), points.end()), points.end());
  return points;
}

std::vector<glm::vec3> outermost_points(const std::vector<glm::vec3>& points) {
  if (points.empty()) return {};
  glm::vec3 low = points.front();
  glm::vec3 high = points.front();
  for (const glm::vec3& p : points) {
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
  const glm::vec3 center = 0.5F * (low + high);
  const float diagonal_m = glm::length(high - low);
  const float curvature = diagonal_m > 0 ? 1 / diagonal_m : 0;
  std::vector<std::size_t> chosen;
  for (int i = 0; i < kDirections; ++i)
    for (const float k : {0.0F, curvature}) chosen.push_back(first_touched(points, center, direction(i), k));
  std::sort(chosen.begin(), chosen.end());
  chosen.erase(std::unique(chosen.begin(), chosen.end()), chosen.end());
  std::vector<glm::vec3> outermost;
  for (const std::size_t i : chosen) outermost.push_back(points[i]);
  return outermost;
}

bool has_word(const std::string& name, std::initializer_list<std::string_view> words) {
  return std::any_of(words.begin(), words.end(),
                     [&](std::string_view word) { return name.find(word) != std::string::npos; });
}

}  // namespace

LampPlaces lamp_places(const Mesh& mesh) {
  LampPlaces places;
  bool is_first = true;
  const auto take = [&](const glm::vec3& p) {
    const auto farther = [&](glm::vec3& place, int axis, float sign) {
      if (is_first || sign * p[axis] > sign * place[axis]) place = p;
    };
    farther(places.left, 1, -1);
    farther(places.right, 1, 1);
    farther(places.tail, 0, -1);
    farther(places.nose, 0, 1);
    farther(places.top, 2, -1);
    farther(places.bottom, 2, 1);
    is_first = false;
  };
  for (const bool with_rotors : {false, true}) {
    if (!is_first) break;  // rotors count where there is nothing else
    for (const MeshPart& part : mesh.parts)
      if (with_rotors || !mesh.materials[static_cast<std::size_t>(part.material)].rotor)
        for (std::uint32_t i = 0; i < part.index_count; ++i)
          take(mesh.vertices[mesh.indices[part.first_index + i]].position_m);
  }
  return places;
}

Model model_of(Mesh mesh) {
  Model model{.mesh = std::move(mesh)};
  model.points_m = measuring_points(model.mesh);
  if (has_rotors(model.mesh)) model.body_m = measuring_points(model.mesh, false);
  model.outermost_m = outermost_points(model.points_m);
  model.shape = shape_of(model.mesh);
  model.lamps = lamp_places(model.mesh);
  return model;
}

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

HeatLevels heat_levels_of(const HeatSettings& heat, const ThermalSettings& thermal) {
  const double sign = thermal.hot == HotChoice::white ? 1 : -1;
  HeatLevels levels{};
  std::size_t i = 0;
  for (const double above_sky : {heat.skin, heat.engine, heat.exhaust, heat.glass, heat.rotor})
    levels[i++] = static_cast<float>(std::max((thermal.sky + sign * above_sky) / 255, 0.0));
  return levels;
}

HeatPart heat_part_of(const Material& material) {
  if (material.rotor) return HeatPart::rotor;
  const std::string name = lower_case(material.name);
  if (has_word(name, {"exhaust", "nozzle", "afterburn"})) return HeatPart::exhaust;
  if (has_word(name, {"engine", "nacelle", "cowl", "grille", "motor", "battery", "intake", "fan"}))
    return HeatPart::engine;
  if (has_word(name, {"propeller", "rotor", "blade"})) return HeatPart::rotor;
  if (has_word(name, {"glass", "window", "canopy", "windshield"}) || material.opacity < 1) return HeatPart::glass;
  return HeatPart::skin;
}

void heat_surfaces(Mesh& mesh, const HeatLevels& levels) {
  for (Material& material : mesh.materials) {
    material.diffuse = glm::vec3(levels[static_cast<std::size_t>(heat_part_of(material))]);
    material.specular = glm::vec3(0);
    material.texture = cv::Mat();
    // A disc that stands for blades stays as thin as it is.
    if (heat_part_of(material) != HeatPart::rotor) material.opacity = 1;
  }
}

}  // namespace sigs
