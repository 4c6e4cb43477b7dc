// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "editor/views/studio.h"
#include "editor/widgets/picture_marks.h"

namespace sigs::editor {

// The line below the picture: what the mouse is over, and what the picture is.
struct ViewportReadout {
  std::optional<cv::Point> pixel;  // under the mouse
  bool of_footage = false;         // its colour is the untouched footage's
  double zoom = 1;
};

[[nodiscard]] float readout_height();
void draw_readout(const Studio& studio, const ViewportReadout& readout);

}  // namespace sigs::editor
