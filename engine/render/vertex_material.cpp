// SPDX-License-Identifier: MIT
#include "render/vertex_material.h"

#include <algorithm>
#include <cstdint>
#include <map>
#include <utility>

#include "base/transfer.h"
#include "render/opacity.h"

namespace sigs {
namespace {

glm::vec3 linear_color(const glm::vec3& display) {
  return {linear_of_display(display.x), linear_of_display(display.y), linear_of_display(display.z)};
}

VertexMaterial vertex_material_of(const Material& material) {
  const float opacity = material.opacity >= kSolidOpacity ? 1.0F : std::max(material.opacity, 0.0F);
  return {{linear_color(material.diffuse), opacity}, {material.specular, std::clamp(material.shininess, 1.0F, 200.0F)}};
}

}  // namespace

Mesh split_by_material(const Mesh& mesh) {
  constexpr int kNone = -1;
  Mesh split = mesh;
  std::vector<int> owner(mesh.vertices.size(), kNone);
  std::map<std::pair<std::uint32_t, int>, std::uint32_t> doubles;
  for (const MeshPart& part : mesh.parts)
    for (std::uint32_t i = part.first_index; i < part.first_index + part.index_count; ++i) {
      std::uint32_t& index = split.indices[i];
      if (owner[index] == kNone) owner[index] = part.material;
      if (owner[index] == part.material) continue;
      const auto [known, is_first] =
          doubles.try_emplace({index, part.material}, static_cast<std::uint32_t>(split.vertices.size()));
      if (is_first) split.vertices.push_back(mesh.vertices[index]);
      index = known->second;
    }
  return split;
}

std::vector<VertexMaterial> vertex_materials(const Mesh& split) {
  std::vector<VertexMaterial> of_materials;
  for (const Material& material : split.materials) of_materials.push_back(vertex_material_of(material));
  std::vector<VertexMaterial> per_vertex(split.vertices.size(), VertexMaterial{});
  for (const MeshPart& part : split.parts)
    for (std::uint32_t i = part.first_index; i < part.first_index + part.index_count; ++i)
      per_vertex[split.indices[i]] = of_materials[part.material];
  return per_vertex;
}

}  // namespace sigs
