// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <utility>

#include "editor/document/document.h"
#include "editor/document/settings.h"
#include "editor/preview/preview_output.h"
#include "editor/preview/scoring.h"
#include "editor/widgets/keys.h"
#include "editor/widgets/textures.h"
#include "editor/widgets/theme.h"
#include "editor/widgets/ui_probe.h"

namespace sigs::editor {

// What the views that are drawn in this update need from the preview. Empty at the start of each update; each view sets
// what it needs while it draws.
struct ViewNeeds {
  bool footage = false;  // the decoded frame without intruders
  bool stages = false;
  std::optional<MethodChoice> compare_with;
  std::optional<PreviewRequest::Turntable> turntable;
  bool own_undo = false;    // the view that is worked in takes undo and redo itself
  bool own_escape = false;  // a view has taken Escape
};

// The input and output of a view in one update. Input: the document, the newest preview, the settings. Output: changes
// and requests of the user in `edits`, what the preview is to compute in `needs`, named places for tests in `ui_probe`.
// A view changes nothing else but its own state (zoom, which overlay is on).
struct ViewContext {
  const Document& document;
  const PreviewOutput& shown;
  const Settings& settings;
  Textures& textures;
  Edits& edits;
  ViewNeeds& needs;
  UiProbe& ui_probe;
  bool playing = false;
  double speed = 0;                // of playing, 0 while it stands
  const Scored* scored = nullptr;  // null: no results of trackers are loaded

  [[nodiscard]] const Project& project() const { return document.project(); }
};

// A drag of the mouse that changes the project. All its changes carry the same gesture name and so make one undo step.
// Escape takes them back; a change that anything else makes to the project meanwhile ends the drag, because its numbers
// may no longer count the same intruders and waypoints.
struct DragGesture {
  std::string name;                   // of the gesture, for Edits::change
  std::uint64_t revision_before = 0;  // of the document when the mouse was pressed
  glm::dvec2 pressed{0, 0};           // where, on the screen
  bool is_moving = false;             // a change has been made or is about to be

  // A press moves nothing until the mouse has gone 3 px (where text is 15 px high).
  [[nodiscard]] bool has_left_press(const glm::dvec2& mouse) const {
    return glm::distance(mouse, pressed) >= static_cast<double>(scaled(3));
  }

  // Whether the project has been changed by anything but this drag.
  [[nodiscard]] bool is_lost(const ViewContext& context) const {
    return context.document.has_other_changes(revision_before, is_moving ? name : "");
  }

  // Whether Escape was pressed in this update; the changes made so far are taken back then.
  [[nodiscard]] bool cancelled_by_key(const ViewContext& context) const {
    if (!sigs::editor::pressed(Key::escape)) return false;
    cancel(context);
    return true;
  }

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
