// SPDX-License-Identifier: MIT
#pragma once

#include "editor/views/studio.h"
#include "editor/widgets/picture_marks.h"

namespace sigs::editor {

// What trackers reported in a frame: a box each, dashed in the tracker's colour on a dark line, so that it shows on
// every ground; a thin line from the truth's middle to its own where they are apart.
void draw_result_boxes(const PictureCanvas& canvas, const Studio& studio, int frame);

// Which colour is whose, with the error in that frame, in the lower left corner.
void draw_result_legend(const PictureCanvas& canvas, const Studio& studio, int frame);

}  // namespace sigs::editor
