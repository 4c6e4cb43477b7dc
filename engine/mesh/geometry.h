// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <string>
#include <vector>

#include "base/result.h"
#include "mesh/mesh.h"

namespace sigs {

// Geometry of triangles and of a model's axes, in double precision.

// The positions of the three corners.
using Triangle = std::array<glm::dvec3, 3>;

// (b - a) x (c - a): the normal of a counter-clockwise triangle, with twice its area as length.
[[nodiscard]] glm::dvec3 doubled_area(const Triangle& triangle);

// Vertex welding: a number for each position, the same for exactly equal positions. Numbers are 0, 1, 2, ... in the
// order in which the positions first occur. O(n).
[[nodiscard]] std::vector<std::uint32_t> welded(std::span<const glm::dvec3> positions);

// Smooth normals where a file has none: a unit vector for each corner of each triangle, three for each triangle, in
// order. It is the mean of the faces that meet at the corner's position and are connected to the corner's own face
// through edges of less than 60 degrees, weighted by the angle at the corner (Thuermer and Wuethrich 1998). Corners
// belong together where their positions are exactly equal. Each triangle must have an area.
[[nodiscard]] std::vector<glm::dvec3> averaged_normals(std::span<const Triangle> triangles);

// The rotation from a model's own axes to body axes: X = forward, Z = -up, Y = Z cross X. Its determinant is +1, so the
// model is never mirrored. Errors (bad_project) name the setting: "forward", "up", "scale", "length_m".
[[nodiscard]] Result<glm::dmat3> body_from_model(const ModelAxes& axes);

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
