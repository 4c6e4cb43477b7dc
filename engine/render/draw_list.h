// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "mesh/mesh.h"

namespace sigs {

// What is drawn, and in which order: solid triangles first, with the depth buffer; then transparent ones from far to
// near.

enum class Surface {
  solid,   // occludes everything behind it
  cutout,  // a solid material whose texture lets light through in places
  glass,   // lets light through everywhere
};

inline constexpr float kSolidOpacity = 0.999F;           // a material of at least this opacity is solid
inline constexpr float kVisibleOpacity = 1.0F / 255.0F;  // a surface of less opacity is not drawn

// The surface of each triangle, in the order of the mesh's parts. Only a triangle over texels that are not opaque is a
// cutout, so that one transparent corner of a texture atlas does not take the depth buffer from a whole aircraft.
[[nodiscard]] std::vector<Surface> surfaces_of(const Mesh& mesh);

// The side of a triangle that cannot be visible from outside the body and therefore need not be drawn.
enum class CullFace { none, back, front };

// The cull face of each triangle, in the order of the mesh's parts. Triangles connected along edges (between exactly
// equal positions) form a watertight surface where each edge is used equally often in both directions. A ray leaves
// such a surface as often as it enters it, so the far side is behind the near side in each sample. Only watertight
// surfaces that are solid throughout and enclose a volume are culled; the sign of the volume says which side is inside.
[[nodiscard]] std::vector<CullFace> cull_faces_of(const Mesh& mesh, const std::vector<Surface>& surfaces);

inline constexpr int kNoTexture = -1;
inline constexpr int kNoRotor = -1;

// Triangles that one call draws: indices [first, first + count).
struct Run {
  int texture = kNoTexture;
  Surface surface = Surface::solid;
  std::uint32_t first = 0;
  std::uint32_t count = 0;
  CullFace hidden = CullFace::none;  // where the eye is outside the body
  int rotor = kNoRotor;              // the material whose blades turn here
};

struct DrawList {
  std::vector<std::uint32_t> indices;  // into the mesh's vertices, three for each triangle
  std::vector<Run> runs;
};

// A triangle that has to be drawn in the order of distance.
struct TransparentTriangle {
  std::uint32_t indices[3];
  int material = 0;
  Surface surface = Surface::glass;
  glm::vec3 centroid_m{0, 0, 0};  // body axes
  bool is_of_rotor = false;
};

// The texture number of each material. Textures are counted from 0; materials that share pixels share the number.
[[nodiscard]] std::vector<int> texture_numbers(const Mesh& mesh);

// What is drawn with the depth buffer only: solid triangles, then cutouts, in the order of the mesh's parts. Among
// neighbouring parts with the same texture, those with the same cull face are put together.
[[nodiscard]] DrawList solid_list(const Mesh& mesh, const std::vector<Surface>& surfaces,
                                  const std::vector<int>& textures);

// Cutouts and glass, without those that are invisible.
[[nodiscard]] std::vector<TransparentTriangle> transparent_triangles(const Mesh& mesh,
                                                                     const std::vector<Surface>& surfaces);

// The triangles from far to near, by the distance of their centroids from the eye (body axes). Triangles at the same
// distance keep their order.
[[nodiscard]] DrawList sorted_list(const std::vector<TransparentTriangle>& triangles, const std::vector<int>& textures,
                                   const glm::dvec3& eye_m);

}  // namespace sigs
