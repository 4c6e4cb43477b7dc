// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "editor/views/context.h"
#include "editor/views/timeline/ruler.h"

namespace sigs::editor {

// One row for each intruder: its waypoints as keys in time, and red where it flies as no such aircraft could. A drag
// moves a key in time, by whole frames unless Alt is held, as one undo step; a double click adds a waypoint on the
// curve; the right button opens a menu.
class KeyRows {
 public:
  // In screen pixels.
  [[nodiscard]] static float row_height();

  // At the cursor, one row below the other; takes the mouse on them.
  void draw(const ViewContext& context, const TimelineStrip& strip);

 private:
  // A key that the mouse holds.
  struct Held {
    int intruder = 0;
    int waypoint = 0;
    // Frames from the mouse to the key.
    double offset = 0;
    // Of the key when it was pressed.
    double frame_before = 0;
    DragGesture gesture;
  };
  // Where the right button was pressed; waypoint -1: on the row itself.
  struct Menu {
    int intruder = 0;
    int waypoint = -1;
    double frame = 0;
    // What is typed into "set frame".
    double typed = 0;
  };
  struct Row;

  void draw_row(const ViewContext& context, const TimelineStrip& strip, int intruder);
  // Notes where the keys are, for tests.
  static void probe_places(const ViewContext& context, const Row& row);
  void handle_mouse(const ViewContext& context, const Row& row);
  void drag(const ViewContext& context, const Row& row);
  // Goes on with the drag of the held key; drops it after Escape or another change of the project.
  void hold(const ViewContext& context, const Row& row);
  // under: the waypoint below the mouse, -1: none.
  void open_menu(const ViewContext& context, const Row& row, int under);
  void draw_menu(const ViewContext& context);
  void draw_key_menu(const ViewContext& context);

  std::optional<Held> held_;
  Menu menu_;
  // The menu is to be opened in this update.
  bool menu_asked_ = false;
};

}  // namespace sigs::editor
