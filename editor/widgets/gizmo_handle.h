// SPDX-License-Identifier: MIT
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <string>
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

// What the mouse did to the handle in this update.
struct GizmoResult {
  std::optional<glm::dvec3> moved_to;  // while it is dragged, once it has left its place
  bool released = false;               // the drag is over
  bool cancelled = false;              // by Esc: back to where it was
  bool wants_numbers = false;          // a double click on an arrow or a plane
  bool wants_middle = false;           // a double click on the middle
};

// The handle of a point on the screen: three arrows, three planes, the middle. It turns the mouse into new positions of
// the point and knows nothing of projects.
class GizmoHandle {
 public:
  // Once per update with the point as it is; takes the mouse.
  [[nodiscard]] GizmoResult update(const glm::dvec3& at_m, const GizmoInput& input);
  void draw(ImDrawList& list, const glm::dvec3& at_m, const GizmoInput& input) const;
  // What it covers on the screen, in small rects.
  [[nodiscard]] std::vector<ScreenRect> covered(const glm::dvec3& at_m, const GizmoInput& input) const;
  // Where its arrows' tips and its middle are: "gizmo/x", ..., "gizmo/middle".
  void probe_places(UiProbe& ui_probe, const glm::dvec3& at_m, const GizmoInput& input) const;
  // Begins a drag of a part with the mouse, which was pressed in this update, elsewhere than on the handle.
  void take(GizmoPart part, const glm::dvec3& at_m);
  // Ends the drag, if there is one, without a result: the point that was dragged is gone.
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

// A small window in which a point is typed: x, y, z in metres. Enter takes it, Esc or a click beside leaves it.
class PointEntry {
 public:
  void open(std::string title, const glm::dvec3& point_m);
  // Once per update, within the same ImGui window each time; the point, in the update in which it is taken.
  [[nodiscard]] std::optional<glm::dvec3> draw();
  [[nodiscard]] bool is_open() const { return state_ != State::closed; }

 private:
  enum class State { closed, asked, open, leaving };

  void draw_fields();

  State state_ = State::closed;
  bool appearing_ = false;
  std::string title_;
  glm::dvec3 point_m_{0, 0, 0};
};

}  // namespace sigs::editor
