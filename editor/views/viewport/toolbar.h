// SPDX-License-Identifier: MIT
#pragma once

#include "editor/views/context.h"
#include "editor/views/viewport/overlays.h"
#include "editor/widgets/zoomable_image.h"

namespace sigs::editor {

// The untouched footage left of a line that is dragged, or, while a key is held, everywhere.
class ViewportWipe {
 public:
  [[nodiscard]] bool is_on() const { return on_; }
  void toggle() { on_ = !on_; }

  // Whether a press there takes hold of the line. Points are on the screen.
  [[nodiscard]] bool is_at(const ImageCanvas& canvas, const glm::dvec2& mouse) const;
  // Whether the untouched footage is shown there, while it is on.
  [[nodiscard]] bool is_left_of_line(const ImageCanvas& canvas, const glm::dvec2& mouse) const;
  // Moves the line to the mouse, but not out of sight.
  void drag_to(const ImageCanvas& canvas, const glm::dvec2& mouse);

  // The footage over the image; asks for it in the context's needs.
  void draw_footage(const ImageCanvas& canvas, const ViewContext& context, bool everywhere);
  void draw_line(const ImageCanvas& canvas, bool highlighted) const;

 private:
  [[nodiscard]] double line_x(const ImageCanvas& canvas) const;

  bool on_ = false;
  // Where the line is, of the width of the canvas: it stays there while the image is zoomed and panned.
  double share_ = 0.5;
};

// What the toolbar above the image switches; it is changed while drawing.
struct ViewportSwitches {
  OverlayChoice& overlays;
  ViewportWipe& wipe;
  ZoomableImage& look;
};

// One row: labels where they have room, else icons alone; what still has no room is in a popup at the end of the row.
void draw_viewport_toolbar(const ViewportSwitches& switches);

}  // namespace sigs::editor
