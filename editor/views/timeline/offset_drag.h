// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "editor/views/context.h"
#include "editor/views/timeline/ruler.h"

namespace sigs::editor {

// Shifts the camera's log in time against the footage: while Alt is held, a drag on a curve of the camera moves the
// curve with the mouse by changing camera.track.offset_s, in steps of a millisecond. One drag is one undo step; Escape
// takes it back.
class OffsetDrag {
 public:
  // On the item "lane" that was drawn last, of the camera. True: the mouse is taken, nothing else may use its press.
  bool update_on_item(const ViewContext& context, const TimelineStrip& strip);
  // Between a press and its release.
  [[nodiscard]] bool is_active() const { return held_.has_value(); }

 private:
  struct Held {
    unsigned int item = 0;  // of ImGui, that the mouse was pressed on
    double offset_before_s = 0;
    DragGesture gesture;
    bool is_over = false;  // cancelled or lost; the button is still down
  };
  void drag(const ViewContext& context, const TimelineStrip& strip);

  std::optional<Held> held_;
  int gestures_ = 0;
};

}  // namespace sigs::editor
