// SPDX-License-Identifier: MIT
#pragma once

#include "editor/views/studio.h"
#include "editor/widgets/picture_marks.h"
#include "editor/widgets/zoomable_picture.h"

namespace sigs::editor {

// The untouched footage left of a line that is dragged, or, while a key is held, everywhere.
class ViewportWipe {
 public:
  [[nodiscard]] bool is_on() const { return on_; }
  void toggle() { on_ = !on_; }

  // Whether a press there takes hold of the line.
  [[nodiscard]] bool is_at(const PictureCanvas& canvas, const glm::dvec2& mouse) const;
  [[nodiscard]] bool is_left_of_line(const PictureCanvas& canvas, const glm::dvec2& mouse) const;
  void drag_to(const PictureCanvas& canvas, const glm::dvec2& mouse);

  // The footage over the picture; asks for it in the studio's wishes.
  void draw_footage(const PictureCanvas& canvas, const Studio& studio, bool everywhere);
  void draw_line(const PictureCanvas& canvas, bool lit) const;

 private:
  [[nodiscard]] double line_x(const PictureCanvas& canvas) const;

  bool on_ = false;
  double share_ = 0.5;  // of the rect's width
};

}  // namespace sigs::editor
