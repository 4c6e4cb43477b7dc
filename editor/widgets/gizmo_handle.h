// SPDX-License-Identifier: MIT
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "editor/geometry/gizmo.h"
#include "editor/widgets/places.h"

struct ImDrawList;

namespace sigs::editor {

// Where a handle is looked at from.
struct GizmoStage {
  const OrbitCamera& camera;
  ScreenRect rect;
  bool mouse_is_free = false;  // over the canvas, nothing else has it
  double snap_m = 0;           // > 0: coordinates are rounded while dragging
};

// What the mouse did to a handle in this turn.
struct GizmoAnswer {
  std::optional<glm::dvec3> moved_to;  // while it is dragged, once it has left its place
  bool released = false;               // the drag is over
  bool cancelled = false;              // by Esc: back to where it was
  bool wants_numbers = false;          // a double click on an arrow or a plane
  bool wants_middle = false;           // a double click on the middle
};

// A handle on the screen: three arrows, three planes, the middle. Knows points and the mouse alone.
class GizmoHandle {
 public:
  // Once a turn with the point as it is; takes the mouse.
  [[nodiscard]] GizmoAnswer update(const glm::dvec3& at_m, const GizmoStage& stage);
  void draw(ImDrawList& list, const glm::dvec3& at_m, const GizmoStage& stage) const;
  // What it covers on the screen, in small rects.
  [[nodiscard]] std::vector<ScreenRect> covered(const glm::dvec3& at_m, const GizmoStage& stage) const;
  // Where its arrows' tips and its middle are: "gizmo/x", ..., "gizmo/middle".
  void note_places(Places& places, const glm::dvec3& at_m, const GizmoStage& stage) const;
  // The mouse, pressed in this turn, has hold of a part.
  void take(GizmoPart part, const glm::dvec3& at_m);
  // The drag, if there is one, is over without an answer: what was dragged has gone.
  void let_go() {
    drag_ = {};
    hovered_ = GizmoPart::none;
  }

  [[nodiscard]] bool dragging() const { return drag_.part != GizmoPart::none; }
  // Under the mouse, or dragged.
  [[nodiscard]] GizmoPart part() const { return dragging() ? drag_.part : hovered_; }
  [[nodiscard]] const glm::dvec3& start_m() const { return drag_.start_m; }

 private:
  [[nodiscard]] GizmoAnswer go_on(const GizmoStage& stage);

  GizmoDrag drag_;
  GizmoPart hovered_ = GizmoPart::none;
  bool has_moved_ = false;
};

}  // namespace sigs::editor
