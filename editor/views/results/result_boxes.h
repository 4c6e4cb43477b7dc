// SPDX-License-Identifier: MIT
#pragma once

#include "editor/views/context.h"
#include "editor/widgets/image_canvas.h"

namespace sigs::editor {

// What trackers reported in a frame: a box each, dashed in the tracker's colour on a dark line, so that it shows on
// every ground; a thin line from the truth's middle to its own where they are apart.
void draw_result_boxes(const ImageCanvas& canvas, const ViewContext& context, int frame);

// Which colour is whose, with the error in that frame, in the lower left corner.
void draw_result_legend(const ImageCanvas& canvas, const ViewContext& context, int frame);

}  // namespace sigs::editor
