// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
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

}  // namespace sigs
