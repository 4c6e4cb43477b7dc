// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "mesh/mesh.h"
#include "render/draw_list.h"

namespace sigs {

// The runs with fewer triangles, off by 2^step metres at most, in place and texture (mesh/simplified.h). All runs
// together, so that they still meet; cutouts stay whole.
[[nodiscard]] DrawList simplified_list(const std::vector<Vertex>& vertices, const DrawList& whole, int step);

// The coarsest step whose error a view may show.
//   error_m  what it may be off; 0 or less, and not finite: none
[[nodiscard]] std::optional<int> step_for(double error_m);

}  // namespace sigs
