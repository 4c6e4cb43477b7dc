// SPDX-License-Identifier: MIT
#include "render/draw_list.h"

#include <algorithm>
#include <cstddef>
#include <numeric>

namespace sigs {
namespace {

void append(DrawList& list, int material, Surface surface, const std::uint32_t* corners,
            HiddenSide hidden = HiddenSide::none) {
  const auto continues = [&](const Run& run) {
    return run.material == material && run.surface == surface && run.hidden == hidden;
  };
  if (list.runs.empty() || !continues(list.runs.back()))
    list.runs.push_back({material, surface, static_cast<std::uint32_t>(list.indices.size()), 0, hidden});
  list.indices.insert(list.indices.end(), corners, corners + 3);
  list.runs.back().count += 3;
}

template <class Visit>
void for_each_triangle(const Mesh& mesh, const std::vector<Surface>& surfaces, Visit visit) {
  std::size_t triangle = 0;
  for (const MeshPart& part : mesh.parts)
    for (std::uint32_t i = 0; i + 2 < part.index_count; i += 3)
      visit(part.material, surfaces[triangle++], &mesh.indices[part.first_index + i]);
}

}  // namespace

DrawList solid_list(const Mesh& mesh, const std::vector<Surface>& surfaces) {
  const std::vector<HiddenSide> hidden = hidden_sides_of(mesh, surfaces);
  DrawList list;
  for (const Surface wanted : {Surface::solid, Surface::cutout}) {
    std::size_t first = 0;  // triangle of the part
    for (const MeshPart& part : mesh.parts) {
      for (const HiddenSide side : {HiddenSide::none, HiddenSide::back, HiddenSide::front})
        for (std::uint32_t i = 0; i + 2 < part.index_count; i += 3)
          if (surfaces[first + i / 3] == wanted && hidden[first + i / 3] == side)
            append(list, part.material, wanted, &mesh.indices[part.first_index + i], side);
      first += part.index_count / 3;
    }
  }
  return list;
}

std::vector<SeeThrough> see_through(const Mesh& mesh, const std::vector<Surface>& surfaces) {
  std::vector<SeeThrough> triangles;
  for_each_triangle(mesh, surfaces, [&](int material, Surface surface, const std::uint32_t* corners) {
    if (surface == Surface::solid) return;
    const glm::vec3 sum = mesh.vertices[corners[0]].position_m + mesh.vertices[corners[1]].position_m +
                          mesh.vertices[corners[2]].position_m;
    triangles.push_back({{corners[0], corners[1], corners[2]}, material, surface, sum / 3.0F});
  });
  return triangles;
}

DrawList sorted_list(const std::vector<SeeThrough>& triangles, const glm::dvec3& eye_m) {
  std::vector<double> distances_m;
  distances_m.reserve(triangles.size());
  for (const SeeThrough& triangle : triangles)
    distances_m.push_back(glm::distance(glm::dvec3(triangle.centroid_m), eye_m));
  std::vector<std::size_t> order(triangles.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return distances_m[a] > distances_m[b]; });
  DrawList list;
  for (const std::size_t i : order) append(list, triangles[i].material, triangles[i].surface, triangles[i].indices);
  return list;
}

}  // namespace sigs
