// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <limits>

#include "mesh/mesh.h"

namespace sigs {

using Corners = std::array<const Vertex*, 3>;

// Shares of the corners in the point of a triangle nearest to p (Ericson, Real-Time Collision Detection, 5.1.5).
[[nodiscard]] glm::dvec3 closest_point_weights(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b,
                                               const glm::dvec3& c);

// How far a vertex lies from the nearest point of a triangle, in place and, if textured, in what the texture shows
// there: the larger, metres. Infinity where it is more than limit_m, or where the normal there differs by more than
// the given sine.
[[nodiscard]] double offset_m(const Vertex& vertex, const Corners& triangle, bool is_textured, double limit_m,
                              double max_sine = 2);

}  // namespace sigs
