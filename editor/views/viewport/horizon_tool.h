// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>

#include "editor/geometry/lens_projection.h"
#include "editor/views/viewport/waypoint_tool.h"

namespace sigs::editor {

// Accepts the line where it lies: writes the camera's present roll and pitch into the project.
void keep_horizon(const ViewContext& context);

// Moves the simulated horizon over the footage's own with the mouse: a drag of the middle half of the line sets the
// camera's pitch, a drag of its ends sets roll (about the line's middle) and pitch. A click without a drag changes
// nothing. One drag is one undo step; Escape takes it back. Where an attitude file or a log turns the camera
// the line cannot be dragged.
class HorizonTool {
 public:
  // For a press of the left button. True: the line was under the mouse and may be dragged.
  bool press(const ToolContext& tool);
  // Each update while it is active and the button is down. A change of the project by anything else ends it.
  void drag(const ToolContext& tool);
  void release(const ViewContext& context);
  // Between a press on the line and release() or Escape.
  [[nodiscard]] bool is_active() const { return taken_.has_value(); }

  // The part of the line that is dragged or, if none is, under the mouse.
  [[nodiscard]] std::optional<HorizonPart> part_at(const ToolContext& tool) const;

  // The line, its handles, and what to do with it while nobody has said where it is.
  void draw(const ToolContext& tool, bool highlighted, LabelPlacer& labels) const;

 private:
  // The drag that lasts.
  struct Taken {
    HorizonPart part = HorizonPart::middle;
    // Of the camera when the drag began.
    HorizonTilt start;
    glm::dvec2 pivot_px{0, 0};   // of the image
    glm::dvec2 offset_px{0, 0};  // from the mouse to the line
    DragGesture gesture;
  };

  std::optional<Taken> taken_;
  int gestures_ = 0;
};

}  // namespace sigs::editor
