// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "mesh/mesh.h"
#include "render/closed.h"
#include "render/opacity.h"

namespace sigs {

// Triangles that are drawn with one call: indices [first, first + count).
struct Run {
  int material = 0;
  Surface surface = Surface::solid;
  std::uint32_t first = 0;
  std::uint32_t count = 0;
  HiddenSide hidden = HiddenSide::none;  // to an eye outside the body
};

struct DrawList {
  std::vector<std::uint32_t> indices;
  std::vector<Run> runs;
};

// A triangle that must be drawn from far to near.
struct SeeThrough {
  std::uint32_t indices[3];
  int material = 0;
  Surface surface = Surface::glass;
  glm::vec3 centroid_m{0, 0, 0};  // body axes
};

// What is drawn with the depth buffer alone, in the order of the mesh's parts: solid triangles and cutouts. Those of a
// part that hide the same side come together.
[[nodiscard]] DrawList solid_list(const Mesh& mesh, const std::vector<Surface>& surfaces);

// Cutouts and glass.
[[nodiscard]] std::vector<SeeThrough> see_through(const Mesh& mesh, const std::vector<Surface>& surfaces);

// Far to near by centroid, as the eye (body axes) sees them; equals keep their order.
[[nodiscard]] DrawList sorted_list(const std::vector<SeeThrough>& triangles, const glm::dvec3& eye_m);

}  // namespace sigs
