// SPDX-License-Identifier: MIT
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "mesh/mesh.h"

namespace sigs {

// The points by which a body is measured, each once: its vertices, and points along its edges no farther apart than a
// hundredth of the diagonal of its bounds, because a lens throws a straight edge as a curve that its ends do not bound.
[[nodiscard]] std::vector<glm::vec3> measuring_points(const Mesh& mesh);

}  // namespace sigs
