// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "editor/views/context.h"
#include "editor/views/timeline/ruler.h"

namespace sigs::editor {

// One row for each intruder: its waypoints as keys in time, and where it flies as no such aircraft could.
class KeyRows {
 public:
  [[nodiscard]] static float row_height();

  // At the cursor, one row below the other.
  void draw(const ViewContext& context, const TimelineStrip& strip);

 private:
  // A key that the mouse holds.
  struct Held {
    int intruder = 0;
    int waypoint = 0;
    double offset = 0;  // frames from the mouse to the key
    double frame_before = 0;
    DragGesture gesture;
  };
  // Where the right button was pressed; waypoint -1: on the row itself.
  struct Menu {
    int intruder = 0;
    int waypoint = -1;
    double frame = 0;
    double typed = 0;  // into "set frame"
  };
  struct Row;

  void draw_row(const ViewContext& context, const TimelineStrip& strip, int intruder);
  static void probe_places(const ViewContext& context, const Row& row);
  void handle_mouse(const ViewContext& context, const Row& row);
  void drag(const ViewContext& context, const Row& row);
  void hold(const ViewContext& context, const Row& row);
  void open_menu(const ViewContext& context, const Row& row, int under);
  void draw_menu(const ViewContext& context);
  void draw_key_menu(const ViewContext& context);

  std::optional<Held> held_;
  Menu menu_;
  bool menu_asked_ = false;
};

}  // namespace sigs::editor
