// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "editor/views/context.h"
#include "editor/widgets/image_canvas.h"

namespace sigs::editor {

// The line below the image: what the mouse is over, and what the image is.
struct ViewportReadout {
  std::optional<cv::Point> pixel;  // under the mouse
  bool of_footage = false;         // its colour is the untouched footage's
  double zoom = 1;
};

[[nodiscard]] float readout_height();
void draw_readout(const ViewContext& context, const ViewportReadout& readout);

}  // namespace sigs::editor
