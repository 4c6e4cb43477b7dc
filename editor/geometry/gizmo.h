// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <optional>

#include "editor/geometry/orbit_camera.h"

namespace sigs::editor {

// The parts of a handle that moves a point: an arrow for each world axis, a square for each plane of two axes, and the
// middle, which moves the point in the plane of the screen.
enum class GizmoPart { none, x, y, z, xy, yz, zx, screen };

// The handle of a point. Its size on the screen does not depend on its distance.
struct Gizmo {
  glm::dvec3 center_m{0, 0, 0};
  double arrow_px = 90;
};

// Lines and quads of the handle on the screen (window pixels); nothing where its centre has no place on the screen.
struct GizmoShape {
  glm::dvec2 center{0, 0};
  std::array<std::optional<glm::dvec2>, 3> tips;                   // none: the axis points at the camera
  std::array<std::optional<std::array<glm::dvec2, 4>>, 3> planes;  // xy, yz, zx; none: the plane is edge-on
};
[[nodiscard]] std::optional<GizmoShape> gizmo_shape(const Gizmo& gizmo, const OrbitCamera& camera,
                                                    const ScreenRect& rect);

// The part within reach_px of the mouse; of several, the middle before planes before arrows.
[[nodiscard]] GizmoPart part_at(const GizmoShape& shape, const glm::dvec2& mouse, double reach_px = 7);

struct GizmoDrag {
  GizmoPart part = GizmoPart::none;
  glm::dvec3 start_m{0, 0, 0};  // of what is dragged
  glm::dvec2 start_mouse{0, 0};
};

// Where the point is once the mouse has come from start_mouse to mouse: the point keeps under the mouse on the axis or
// plane. Where that has no answer (an axis that points at the camera, a plane beyond its horizon) it stays at start_m.
// Always finite, never farther than 1e8 m from the world's origin in any axis. snap_m > 0: the coordinates that move
// are rounded to multiples of it.
[[nodiscard]] glm::dvec3 dragged(const GizmoDrag& drag, const glm::dvec2& mouse, const OrbitCamera& camera,
                                 const ScreenRect& rect, double snap_m = 0);

// A step that suits the zoom: 1, 2 or 5 times a power of ten, about 8 screen pixels or more.
[[nodiscard]] double snap_step_m(const OrbitCamera& camera, const glm::dvec3& at_m, const ScreenRect& rect);

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
