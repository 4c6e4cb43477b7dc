// SPDX-License-Identifier: MIT
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "mesh/mesh.h"

namespace sigs {

// A material as the shaders take it with every vertex, so that many materials are drawn with one call.
struct VertexMaterial {
  glm::vec4 color;  // linear diffuse; opacity, 1 where solid
  glm::vec4 gloss;  // specular; shininess within 1..200
};

// The same mesh with every vertex in triangles of one material alone: those that several share are doubled.
[[nodiscard]] Mesh split_by_material(const Mesh& mesh);

// One for each vertex of a mesh that was split.
[[nodiscard]] std::vector<VertexMaterial> vertex_materials(const Mesh& split);

}  // namespace sigs
