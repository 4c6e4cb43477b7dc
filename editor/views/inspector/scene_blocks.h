// SPDX-License-Identifier: MIT
#pragma once

#include "editor/views/inspector/field_rows.h"

namespace sigs::editor {

// Footage, calibration and own-body mask, and what was found in the video and the calibration.
void draw_inputs(const ViewContext& context, FieldRows& rows);

// The intruders as a list with buttons to add and remove, and the model of the one that is worked on, with an image of
// it that is turned by dragging.
class ModelBlock {
 public:
  void draw(const ViewContext& context, FieldRows& rows);

 private:
  void draw_list(const ViewContext& context, const FieldRows& rows);
  void draw_preview(const ViewContext& context, int intruder);

  // Of the turntable, as PreviewRequest::Turntable.
  double turn_rad_ = 0;
};

}  // namespace sigs::editor
