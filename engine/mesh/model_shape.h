// SPDX-License-Identifier: MIT
#pragma once

#include <glm/glm.hpp>
#include <string>

#include "mesh/mesh.h"

namespace sigs {

// Which way the nose and the top of an aircraft's model point, judged by its shape:
//   wings  the axis about whose middle the model is most nearly its own mirror image
//   nose   of the other two axes the longer one; the nose is the end with less spread: the tail has fin and tailplane
//   top    the shorter one; the fin stands up at the tail
// Each is an axis of the mesh's body axes, a unit vector with one part of +1 or -1. A part that the shape does not tell
// (a quadcopter has no tail) is that of the mesh as it is, and not sure.
struct ModelShape {
  glm::dvec3 nose{1, 0, 0};
  glm::dvec3 top{0, 0, -1};
  bool wings_are_sure = false;  // which axis is the wings', and that the other two differ
  bool nose_is_sure = false;    // which end is the nose
  bool top_is_sure = false;     // which side is the top
};

// Of a mesh with at least one triangle with an area. Some 30 ms for 100,000 triangles.
[[nodiscard]] ModelShape shape_of(const Mesh& mesh);

// The direction as an axis of the model file that was read with these axes: "-x". direction: one part of +1 or -1.
[[nodiscard]] std::string file_axis(const glm::dvec3& direction_in_body, const ModelAxes& axes);

}  // namespace sigs
