// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <utility>

#include "editor/views/context.h"
#include "editor/widgets/keys.h"
#include "editor/widgets/theme.h"

namespace sigs::editor {

// A drag of the mouse that changes the project. All its changes carry the same gesture name and so make one undo step.
// Escape takes them back; a change that anything else makes to the project meanwhile ends the drag, because its numbers
// may no longer count the same intruders and waypoints.
struct DragGesture {
  // Of the gesture, for Edits::change. Two drags that follow each other need different names, or an end() between them.
  std::string name;
  // Number of the document's revision when the mouse was pressed.
  std::uint64_t revision_before = 0;
  // Where it was pressed, on the screen.
  glm::dvec2 pressed{0, 0};
  // A change has been made or is about to be. The caller sets it, once has_left_press().
  bool is_moving = false;

  // A press moves nothing until the mouse has gone 3 px (where text is 15 px high).
  [[nodiscard]] bool has_left_press(const glm::dvec2& mouse) const {
    return glm::distance(mouse, pressed) >= static_cast<double>(scaled(3));
  }

  // Whether the project has been changed by anything but this drag. The caller drops the drag then, without an end().
  [[nodiscard]] bool is_lost(const ViewContext& context) const {
    return context.document.has_other_changes(revision_before, is_moving ? name : "");
  }

  // Whether Escape was pressed in this update; the changes made so far are taken back then.
  [[nodiscard]] bool cancelled_by_key(const ViewContext& context) const {
    if (!sigs::editor::pressed(Key::escape)) return false;
    cancel(context);
    return true;
  }

  // Takes back all changes of this drag.
  void cancel(const ViewContext& context) const {
    if (is_moving) context.edits.cancel_gesture(name);
  }

  // When the mouse is let go: the undo step is complete.
  void end(const ViewContext& context) const {
    if (is_moving) context.edits.end_gesture();
  }
};

// A drag that begins at a place of the screen in this update.
[[nodiscard]] inline DragGesture drag_gesture_at(const ViewContext& context, const glm::dvec2& mouse,
                                                 std::string name = {}) {
  return {.name = std::move(name), .revision_before = context.document.revision().number, .pressed = mouse};
}

}  // namespace sigs::editor
