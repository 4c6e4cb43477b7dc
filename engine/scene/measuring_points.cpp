// SPDX-License-Identifier: MIT
#include "scene/measuring_points.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

namespace sigs {

namespace {

constexpr double kGapsAlongDiagonal = 100;

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

}  // namespace

std::vector<glm::vec3> measuring_points(const Mesh& mesh) {
  std::vector<glm::vec3> points;
  points.reserve(mesh.vertices.size());
  for (const Vertex& vertex : mesh.vertices) points.push_back(vertex.position_m);
  const double gap_m = glm::length(glm::dvec3(mesh.high_m) - glm::dvec3(mesh.low_m)) / kGapsAlongDiagonal;
  for (std::size_t i = 0; gap_m > 0 && i + 2 < mesh.indices.size(); i += 3)
    for (std::size_t side = 0; side < 3; ++side)
      add_between(mesh.vertices[mesh.indices[i + side]].position_m,
                  mesh.vertices[mesh.indices[i + (side + 1) % 3]].position_m, gap_m, points);
  std::sort(points.begin(), points.end(), before);
  points.erase(std::unique(points.begin(), points.end()), points.end());
  return points;
}

}  // namespace sigs
