// SPDX-License-Identifier: MIT
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "mesh/mesh.h"
#include "scene/scene.h"

namespace sigs {

// The points by which a body is measured, each once: its vertices, and points along its edges no farther apart than a
// hundredth of the diagonal of its bounds, because a lens throws a straight edge as a curve that its ends do not bound.
[[nodiscard]] std::vector<glm::vec3> measuring_points(const Mesh& mesh);

// Those of the points that bound a body, at most 200: where planes from many directions first touch it, and where
// bowed sheets do, curved by a radius of the body's own size, which finds the middles of long edges that a lens bows.
// A box around their images is that of all points to 1 % of its longer side, from two lengths' distance on.
[[nodiscard]] std::vector<glm::vec3> outermost_points(const std::vector<glm::vec3>& points);

// A mesh with all that a scene knows of it.
[[nodiscard]] Model model_of(Mesh mesh);

}  // namespace sigs
