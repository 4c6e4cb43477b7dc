// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

namespace sigs {

// Cuts a polygon, which may be concave and need not be quite flat, into triangles by ear clipping (Meisters 1975).
// Returns corner_count - 2 triples of corner numbers, wound as the polygon is; none for fewer than 3 corners. Up to
// some hundred corners each is held against each other; more are found in a grid, in time that grows with their number.
// Nothing where that takes 2000 looks a corner: long thin teeth without end (docs/limits.md).
[[nodiscard]] std::optional<std::vector<std::array<int, 3>>> triangulated(std::span<const glm::vec3> corners);

}  // namespace sigs
