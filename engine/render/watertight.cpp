// SPDX-License-Identifier: MIT
#include "render/watertight.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <numeric>

#include "base/disjoint_sets.h"

namespace sigs {
namespace {

using Triangle = std::array<std::uint32_t, 3>;

bool is_before(const glm::vec3& a, const glm::vec3& b) {
  return std::array{a.x, a.y, a.z} < std::array{b.x, b.y, b.z};
}

// For each vertex the first one in the same place.
std::vector<std::uint32_t> welded(const std::vector<Vertex>& vertices) {
  std::vector<std::uint32_t> order(vertices.size());
  std::iota(order.begin(), order.end(), 0U);
  std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return is_before(vertices[a].position_m, vertices[b].position_m);
  });
  std::vector<std::uint32_t> first(vertices.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    const bool is_same = i > 0 && vertices[order[i]].position_m == vertices[order[i - 1]].position_m;
    first[order[i]] = is_same ? first[order[i - 1]] : order[i];
  }
  return first;
}

std::vector<Triangle> triangles_of(const Mesh& mesh) {
  const std::vector<std::uint32_t> first = welded(mesh.vertices);
  std::vector<Triangle> triangles;
  triangles.reserve(mesh.indices.size() / 3);
  for (const MeshPart& part : mesh.parts)
    for (std::uint32_t i = 0; i + 2 < part.index_count; i += 3) {
      const std::uint32_t* corners = &mesh.indices[part.first_index + i];
      triangles.push_back({first[corners[0]], first[corners[1]], first[corners[2]]});
    }
  return triangles;
}

// A side of a triangle, of which the one that runs from the lower to the higher vertex counts as forward.
struct Edge {
  std::uint32_t low;
  std::uint32_t high;
  std::uint32_t triangle;
  int direction;

  [[nodiscard]] bool joins(const Edge& other) const { return low == other.low && high == other.high; }
  [[nodiscard]] auto operator<=>(const Edge&) const = default;
};

std::vector<Edge> sorted_edges(const std::vector<Triangle>& triangles) {
  std::vector<Edge> edges;
  edges.reserve(3 * triangles.size());
  for (std::uint32_t t = 0; t < triangles.size(); ++t)
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t a = triangles[t][i];
      const std::uint32_t b = triangles[t][(i + 1) % 3];
      if (a != b) edges.push_back({std::min(a, b), std::max(a, b), t, a < b ? 1 : -1});
    }
  std::sort(edges.begin(), edges.end());
  return edges;
}

// By the root of its set.
struct Shell {
  bool is_closed = true;
  double volume_m3 = 0;  // times 6
  double area_m2 = 0;    // times 2
};

CullFace cull_face_of(const Shell& shell) {
  // A sheet with two sides encloses nothing: it has an area, and a volume of rounding.
  constexpr double kMinVolume = 1e-6;
  if (!shell.is_closed || !(std::abs(shell.volume_m3) > kMinVolume * std::pow(shell.area_m2, 1.5)))
    return CullFace::none;
  return shell.volume_m3 > 0 ? CullFace::back : CullFace::front;
}

void measure(Shell& shell, const Triangle& triangle, const std::vector<Vertex>& vertices, const glm::dvec3& origin_m) {
  const glm::dvec3 a = glm::dvec3(vertices[triangle[0]].position_m) - origin_m;
  const glm::dvec3 b = glm::dvec3(vertices[triangle[1]].position_m) - origin_m;
  const glm::dvec3 c = glm::dvec3(vertices[triangle[2]].position_m) - origin_m;
  shell.volume_m3 += glm::dot(a, glm::cross(b, c));
  shell.area_m2 += glm::length(glm::cross(b - a, c - a));
}

// Joins triangles along edges, and calls open() with those of every edge that leaves the surface open.
template <class Open>
void join_along(const std::vector<Edge>& edges, DisjointSets& disjoint_sets, Open open) {
  for (auto edge = edges.begin(); edge != edges.end();) {
    const auto end = std::find_if(edge, edges.end(), [&](const Edge& other) { return !edge->joins(other); });
    int sum = 0;
    for (auto each = edge; each != end; ++each) {
      sum += each->direction;
      disjoint_sets.join(edge->triangle, each->triangle);
    }
    if (sum != 0) open(edge->triangle);
    edge = end;
  }
}

}  // namespace

std::vector<CullFace> cull_faces_of(const Mesh& mesh, const std::vector<Surface>& surfaces) {
  const std::vector<Triangle> triangles = triangles_of(mesh);
  DisjointSets disjoint_sets(triangles.size());
  std::vector<std::uint32_t> on_rims;
  join_along(sorted_edges(triangles), disjoint_sets, [&](std::uint32_t triangle) { on_rims.push_back(triangle); });

  std::vector<Shell> shells(triangles.size());
  for (const std::uint32_t triangle : on_rims) shells[disjoint_sets.root(triangle)].is_closed = false;
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    const std::uint32_t root = disjoint_sets.root(t);
    if (surfaces[t] != Surface::solid) shells[root].is_closed = false;
    measure(shells[root], triangles[t], mesh.vertices, mesh.vertices[triangles[root][0]].position_m);
  }
  std::vector<CullFace> sides;
  sides.reserve(triangles.size());
  for (std::uint32_t t = 0; t < triangles.size(); ++t) sides.push_back(cull_face_of(shells[disjoint_sets.root(t)]));
  return sides;
}

}  // namespace sigs
