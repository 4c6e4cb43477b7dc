// SPDX-License-Identifier: MIT
#pragma once

#include "editor/views/inspector/field_rows.h"

namespace sigs::editor {

// The intruders, and the model of the one that is worked on.
class ModelBlock {
 public:
  void draw(const ViewContext& context, FieldRows& rows);

 private:
  void draw_list(const ViewContext& context, const FieldRows& rows);
  void draw_preview(const ViewContext& context, int intruder);

  double turn_rad_ = 0;  // of the turntable
};

}  // namespace sigs::editor
