// SPDX-License-Identifier: MIT
#pragma once

#include <glm/glm.hpp>

#include "base/result.h"
#include "mesh/mesh.h"

namespace sigs {

// The rotation that takes a model's own axes to body axes: X = forward, Z = -up, Y = Z cross X. Its determinant is +1.
// Errors (bad_project) name the setting: "forward", "up", "scale", "length_m".
[[nodiscard]] Result<glm::dmat3> body_from_model(const ModelAxes& axes);

}  // namespace sigs
