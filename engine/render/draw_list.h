// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "mesh/mesh.h"
#include "render/opacity.h"
#include "render/watertight.h"

namespace sigs {

inline constexpr int kNoTexture = -1;
inline constexpr float kVisibleOpacity = 1.0F / 255.0F;  // below, light passes as if nothing were there

// Triangles that are drawn with one call: indices [first, first + count).
struct Run {
  int texture = kNoTexture;
  Surface surface = Surface::solid;
  std::uint32_t first = 0;
  std::uint32_t count = 0;
  CullFace hidden = CullFace::none;  // to an eye outside the body
};

[[nodiscard]] inline bool is_drawn_alike(const Run& a, const Run& b) {
  return a.texture == b.texture && a.surface == b.surface && a.hidden == b.hidden;
}

struct DrawList {
  std::vector<std::uint32_t> indices;
  std::vector<Run> runs;
};

// A triangle that must be drawn from far to near.
struct TransparentTriangle {
  std::uint32_t indices[3];
  int material = 0;
  Surface surface = Surface::glass;
  glm::vec3 centroid_m{0, 0, 0};  // body axes
};

// For each material the number of its texture, counted from 0 by the pixels that materials share.
[[nodiscard]] std::vector<int> texture_numbers(const Mesh& mesh);

// What is drawn with the depth buffer alone: solid triangles, then cutouts, in the order of the mesh's parts. Of
// neighbouring parts with the same texture, those that hide the same side come together.
[[nodiscard]] DrawList solid_list(const Mesh& mesh, const std::vector<Surface>& surfaces,
                                  const std::vector<int>& textures);

// Cutouts and glass, as far as they can be seen at all.
[[nodiscard]] std::vector<TransparentTriangle> transparent_triangles(const Mesh& mesh,
                                                                     const std::vector<Surface>& surfaces);

// Far to near by centroid, as the eye (body axes) sees them; equals keep their order.
[[nodiscard]] DrawList sorted_list(const std::vector<TransparentTriangle>& triangles, const std::vector<int>& textures,
                                   const glm::dvec3& eye_m);

}  // namespace sigs
