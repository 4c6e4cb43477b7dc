// SPDX-License-Identifier: MIT
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "editor/geometry/lens_projection.h"
#include "editor/views/viewport/waypoint_tool.h"
#include "editor/widgets/zoomable_image.h"

namespace sigs::editor {

// A mark across the horizon at a heading, through the lens.
struct HeadingMark {
  double heading_deg = 0;  // 0 <= h < 360, from the reference to the right
  glm::dvec2 pixel{0, 0};  // of the image, on the horizon
  glm::dvec2 up{0, -1};    // unit vector of the image from there to the zenith
  bool is_numbered = false;
};

// The marks that the image shows.
//   reference_rad  heading of world X against the reference that is counted from
//   number_gap_deg  numbers stand at least so far apart: 5, 10, 30, 45 or 90 degrees
[[nodiscard]] std::vector<HeadingMark> heading_marks(const FootageCamera& eye, const glm::dvec2& image_px,
                                                     double reference_rad, double number_gap_deg);

// "0", "45", "350" against world X; "N", "045", "350" against true north.
[[nodiscard]] std::string heading_text(double heading_deg, bool from_north);

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
