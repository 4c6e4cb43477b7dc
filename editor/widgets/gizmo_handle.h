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

// Where a handle is looked at from in this update. The camera has to outlive it.
struct GizmoInput {
  const OrbitCamera& camera;
  ScreenRect rect;  // of the view on the screen
  // The mouse is over the canvas and nothing else has it. A drag goes on without it.
  bool mouse_is_free = false;
  double snap_m = 0;  // > 0: coordinates are rounded to multiples of it while dragging
};

// What the mouse did to the handle in this update.
struct GizmoResult {
  // In the world: where the point is to be, while it is dragged and once the mouse has gone 3 px.
  std::optional<glm::dvec3> moved_to;
  bool released = false;       // the drag is over; moved_to of the same update still counts
  bool cancelled = false;      // by Esc: the point is to be where it was (start_m())
  bool wants_numbers = false;  // a double click on an arrow or a plane: the point is to be typed
  bool wants_middle = false;   // a double click on the middle
};

// The handle of a point on the screen: three arrows along the world's axes, three planes, and the middle, which moves
// the point in the plane of the screen. It turns the mouse into new positions of the point and knows nothing of
// projects: the caller moves the point and passes it in again. Points are of the world, in metres. Within an ImGui
// update, on the window's thread.
class GizmoHandle {
 public:
  // Once per update with the point as it is; takes the mouse. Where the point is behind the camera of the view, it has
  // no handle.
  [[nodiscard]] GizmoResult update(const glm::dvec3& at_m, const GizmoInput& input);
  // After the world that it lies on.
  void draw(ImDrawList& list, const glm::dvec3& at_m, const GizmoInput& input) const;
  // What it covers on the screen, in small rects, so that labels can keep away from it.
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

  // Between the press, or take(), and its release or end.
  [[nodiscard]] bool dragging() const { return drag_.part != GizmoPart::none; }
  // Under the mouse, or dragged; none otherwise.
  [[nodiscard]] GizmoPart part() const { return dragging() ? drag_.part : hovered_; }
  // Where the point was when the drag began; meaningful while dragging().
  [[nodiscard]] const glm::dvec3& start_m() const { return drag_.start_m; }

 private:
  [[nodiscard]] GizmoResult continue_drag(const GizmoInput& input);

  GizmoDrag drag_;
  GizmoPart hovered_ = GizmoPart::none;
  // The mouse has gone 3 px since the press: a click that trembles moves nothing.
  bool has_moved_ = false;
};

// A small window in which a point is typed: x, y, z in metres in the world frame (forward, right, down). Enter takes
// it, Esc or a click beside leaves it.
class PointEntry {
 public:
  // It appears at the next draw(), beside the mouse, with these numbers.
  void open(std::string title, const glm::dvec3& point_m);
  // Once per update, within the same ImGui window each time; the point, in the update in which it is taken. It is
  // finite and each coordinate within +-1e8 m.
  [[nodiscard]] std::optional<glm::dvec3> draw();
  [[nodiscard]] bool is_open() const { return state_ != State::closed; }

 private:
  // asked: to be opened by the next draw(). leaving: it closes one update after the key that closes it, so that nothing
  // else takes that key.
  enum class State { closed, asked, open, leaving };

  void draw_fields();

  State state_ = State::closed;
  bool appearing_ = false;
  std::string title_;
  glm::dvec3 point_m_{0, 0, 0};
};

}  // namespace sigs::editor
