// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "editor/geometry/horizon_drag.h"
#include "editor/views/viewport/waypoint_tool.h"

namespace sigs::editor {

// Says that the line lies right where it is: roll and pitch are set from then on.
void keep_horizon(const ViewContext& context);

// Lays the horizon's line over the footage's own: its middle half is dragged for pitch, its ends for roll about the
// line's middle. A click without a drag changes nothing. One drag is one step of undo; Esc takes it back. Where an
// attitude file says how the camera is turned, the line stays where it is.
class HorizonTool {
 public:
  // Whether the press took hold of the line.
  bool press(const ToolContext& tool);
  void drag(const ToolContext& tool);
  void release(const ViewContext& context);
  [[nodiscard]] bool is_active() const { return taken_.has_value(); }

  // What is under the mouse, or held.
  [[nodiscard]] std::optional<HorizonPart> part_at(const ToolContext& tool) const;

  // The line, its handles, and what to do with it while nobody has said where it is.
  void draw(const ToolContext& tool, bool highlighted, ImageLabels& labels) const;

 private:
  struct Taken {
    HorizonPart part = HorizonPart::middle;
    HorizonTilt start;
    glm::dvec2 pivot_px{0, 0};   // of the image
    glm::dvec2 offset_px{0, 0};  // from the mouse to the line
    glm::dvec2 pressed{0, 0};    // where the mouse was, on the screen
    std::uint64_t revision_before = 0;
    std::string gesture;
    bool is_moving = false;
  };

  std::optional<Taken> taken_;
  int gestures_ = 0;
};

}  // namespace sigs::editor
