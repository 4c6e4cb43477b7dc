// SPDX-License-Identifier: MIT
#pragma once

#include "editor/views/viewport/overlays.h"
#include "editor/views/viewport/wipe.h"
#include "editor/widgets/zoomable_image.h"

namespace sigs::editor {

// What the toolbar above the image switches.
struct ViewportSwitches {
  OverlayChoice& overlays;
  ViewportWipe& wipe;
  ZoomableImage& look;
};

// One row: labels where they have room, else icons alone; what has no room at all is left out.
void draw_viewport_toolbar(const ViewportSwitches& switches);

}  // namespace sigs::editor
