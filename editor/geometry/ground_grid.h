// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "editor/geometry/orbit_camera.h"

namespace sigs::editor {

struct GridLine {
  std::array<glm::dvec3, 2> ends_m;  // in the world, z = 0
  bool bold = false;
  double at_m = 0;      // the coordinate that all of it has
  bool is_of_x = true;  // whether that is x
};

// The ground, world z = 0, ruled in metres.
struct GroundGrid {
  double step_m = 1;
  std::vector<GridLine> lines;
};

// Lines at 1, 2 or 5 times a power of ten metres, 40 screen pixels or more apart where the eye looks; every tenth (of
// twos: fifth) bold. At most 200 lines around the place of the ground in the middle of the screen, or under the target
// where the ground is not to be seen there.
[[nodiscard]] GroundGrid ground_grid(const OrbitCamera& camera, const ScreenRect& rect);

// "0", "250 m", "1.5 km".
[[nodiscard]] std::string round_distance_text(double distance_m);

}  // namespace sigs::editor
