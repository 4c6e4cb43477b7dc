// SPDX-License-Identifier: MIT
#include "render/draw_list.h"

#include <algorithm>
#include <cstddef>
#include <map>
#include <numeric>

namespace sigs {
namespace {

void append(DrawList& list, int texture, Surface surface, const std::uint32_t* corners,
            CullFace hidden = CullFace::none) {
  const Run run{texture, surface, static_cast<std::uint32_t>(list.indices.size()), 0, hidden};
  if (list.runs.empty() || !is_drawn_alike(list.runs.back(), run)) list.runs.push_back(run);
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

// Parts [first, last), whose first triangle is so many after the mesh's.
struct Group {
  std::size_t first;
  std::size_t last;
  std::size_t triangle;
};

std::vector<Group> groups_of(const Mesh& mesh, const std::vector<int>& textures) {
  std::vector<Group> groups;
  std::size_t triangle = 0;
  for (std::size_t i = 0; i < mesh.parts.size(); ++i) {
    const auto texture = [&](std::size_t part) { return textures[mesh.parts[part].material]; };
    if (groups.empty() || texture(groups.back().first) != texture(i)) groups.push_back({i, i, triangle});
    groups.back().last = i + 1;
    triangle += mesh.parts[i].index_count / 3;
  }
  return groups;
}

}  // namespace

std::vector<int> texture_numbers(const Mesh& mesh) {
  std::map<const unsigned char*, int> known;
  std::vector<int> textures;
  for (const Material& material : mesh.materials)
    textures.push_back(material.texture.empty()
                           ? kNoTexture
                           : known.try_emplace(material.texture.data, static_cast<int>(known.size())).first->second);
  return textures;
}

DrawList solid_list(const Mesh& mesh, const std::vector<Surface>& surfaces, const std::vector<int>& textures) {
  const std::vector<CullFace> hidden = cull_faces_of(mesh, surfaces);
  const std::vector<Group> groups = groups_of(mesh, textures);
  DrawList list;
  const auto append_of = [&](const Group& group, Surface wanted, CullFace side) {
    std::size_t triangle = group.triangle;
    for (std::size_t p = group.first; p < group.last; ++p) {
      const MeshPart& part = mesh.parts[p];
      for (std::uint32_t i = 0; i + 2 < part.index_count; i += 3, ++triangle)
        if (surfaces[triangle] == wanted && hidden[triangle] == side)
          append(list, textures[part.material], wanted, &mesh.indices[part.first_index + i], side);
    }
  };
  for (const Surface wanted : {Surface::solid, Surface::cutout})
    for (const Group& group : groups)
      for (const CullFace side : {CullFace::none, CullFace::back, CullFace::front}) append_of(group, wanted, side);
  return list;
}

std::vector<TransparentTriangle> transparent_triangles(const Mesh& mesh, const std::vector<Surface>& surfaces) {
  std::vector<TransparentTriangle> triangles;
  for_each_triangle(mesh, surfaces, [&](int material, Surface surface, const std::uint32_t* corners) {
    if (surface == Surface::solid || !(mesh.materials[material].opacity >= kVisibleOpacity)) return;
    const glm::vec3 sum = mesh.vertices[corners[0]].position_m + mesh.vertices[corners[1]].position_m +
                          mesh.vertices[corners[2]].position_m;
    triangles.push_back({{corners[0], corners[1], corners[2]}, material, surface, sum / 3.0F});
  });
  return triangles;
}

DrawList sorted_list(const std::vector<TransparentTriangle>& triangles, const std::vector<int>& textures,
                     const glm::dvec3& eye_m) {
  std::vector<double> distances_m;
  distances_m.reserve(triangles.size());
  for (const TransparentTriangle& triangle : triangles)
    distances_m.push_back(glm::distance(glm::dvec3(triangle.centroid_m), eye_m));
  std::vector<std::size_t> order(triangles.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return distances_m[a] > distances_m[b]; });
  DrawList list;
  for (const std::size_t i : order)
    append(list, textures[triangles[i].material], triangles[i].surface, triangles[i].indices);
  return list;
}

}  // namespace sigs
