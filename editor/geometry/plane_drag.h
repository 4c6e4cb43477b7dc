// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <glm/glm.hpp>

#include "editor/geometry/orbit_camera.h"

namespace sigs::editor {

// A drag of a point that stays in the plane of two perpendicular unit vectors.
struct PlaneDrag {
  glm::dvec3 start_m{0, 0, 0};
  std::array<glm::dvec3, 2> axes{glm::dvec3(0, 1, 0), glm::dvec3(0, 0, -1)};
  glm::dvec2 start_mouse{0, 0};
};

// How far the point goes along the two axes once the mouse has come from start_mouse to mouse: it keeps under the
// mouse. Where the view looks along the plane (within 11 degrees), it moves along the axis that is seen longer, and not
// at all along the other one. Where there is no answer (beyond the plane's horizon) it stays: (0, 0). Always finite,
// each within 1e8 m.
[[nodiscard]] glm::dvec2 dragged_in_plane_m(const PlaneDrag& drag, const glm::dvec2& mouse, const OrbitCamera& camera,
                                            const ScreenRect& rect);

}  // namespace sigs::editor
