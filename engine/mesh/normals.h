// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace sigs {

using Triangle = std::array<glm::dvec3, 3>;

// (b - a) x (c - a): along the normal of a counter-clockwise triangle, as long as twice its area.
[[nodiscard]] glm::dvec3 doubled_area(const Triangle& triangle);

// Unit normal for each corner of each triangle (3 a triangle, in order): the mean of the faces that meet at the
// corner's position and are joined to its own through edges of less than 60 degrees, weighted by the angle at the
// corner (Thuermer and Wuethrich 1998). Triangles must have an area. Corners at the very same position belong together.
[[nodiscard]] std::vector<glm::dvec3> averaged_normals(std::span<const Triangle> triangles);

}  // namespace sigs
