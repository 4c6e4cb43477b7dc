// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "mesh/mesh.h"
#include "render/draw_list.h"

namespace sigs {

// Solid runs with fewer triangles, and how far they are off the whole ones: position and picture, metres.
struct Detail {
  DrawList list;
  double error_m = 0;
};

// Off by 2^step metres at most. Connected pieces of each run are simplified one by one with their borders kept, so that
// neighbours still meet; cutouts stay whole, and so do pieces that would come out further off.
[[nodiscard]] Detail detail_of(const std::vector<Vertex>& vertices, const DrawList& whole, int step);

// The coarsest step whose error a view may show.
//   error_m  what it may be off; 0 or less, and not finite: none
[[nodiscard]] std::optional<int> step_for(double error_m);

}  // namespace sigs
