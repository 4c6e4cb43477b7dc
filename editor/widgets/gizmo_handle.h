// SPDX-License-Identifier: MIT
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "editor/geometry/gizmo.h"
#include "editor/widgets/ui_probe.h"

struct ImDrawList;

namespace sigs::editor {

// Where a handle is looked at from.
struct GizmoInput {
  const OrbitCamera& camera;
  ScreenRect rect;
  bool mouse_is_free = false;  // over the canvas, nothing else has it
  double snap_m = 0;           // > 0: coordinates are rounded while dragging
};

// What the mouse did to a handle in this update.
struct GizmoResult {
  std::optional<glm::dvec3> moved_to;  // while it is dragged, once it has left its place
  bool released = false;               // the drag is over
  bool cancelled = false;              // by Esc: back to where it was
  bool wants_numbers = false;          // a double click on an arrow or a plane
  bool wants_middle = false;           // a double click on the middle
};

// A handle on the screen: three arrows, three planes, the middle. Knows points and the mouse alone.
class GizmoHandle {
 public:
  // Once per update with the point as it is; takes the mouse.
  [[nodiscard]] GizmoResult update(const glm::dvec3& at_m, const GizmoInput& input);
  void draw(ImDrawList& list, const glm::dvec3& at_m, const GizmoInput& input) const;
  // What it covers on the screen, in small rects.
  [[nodiscard]] std::vector<ScreenRect> covered(const glm::dvec3& at_m, const GizmoInput& input) const;
  // Where its arrows' tips and its middle are: "gizmo/x", ..., "gizmo/middle".
  void probe_places(UiProbe& ui_probe, const glm::dvec3& at_m, const GizmoInput& input) const;
  // The mouse, pressed in this update, has hold of a part.
  void take(GizmoPart part, const glm::dvec3& at_m);
  // The drag, if there is one, is over without an answer: what was dragged has gone.
  void abandon_drag() {
    drag_ = {};
    hovered_ = GizmoPart::none;
  }

  [[nodiscard]] bool dragging() const { return drag_.part != GizmoPart::none; }
  // Under the mouse, or dragged.
  [[nodiscard]] GizmoPart part() const { return dragging() ? drag_.part : hovered_; }
  [[nodiscard]] const glm::dvec3& start_m() const { return drag_.start_m; }

 private:
  [[nodiscard]] GizmoResult continue_drag(const GizmoInput& input);

  GizmoDrag drag_;
  GizmoPart hovered_ = GizmoPart::none;
  bool has_moved_ = false;
};

}  // namespace sigs::editor
