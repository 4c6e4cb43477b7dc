// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace sigs {

// Cuts a polygon, which may be concave and need not be quite flat, into triangles by ear clipping (Meisters 1975).
// Returns corner_count - 2 triples of corner numbers, wound as the polygon is. Nothing for fewer than 3 corners.
[[nodiscard]] std::vector<std::array<int, 3>> triangulated(std::span<const glm::vec3> corners);

}  // namespace sigs
