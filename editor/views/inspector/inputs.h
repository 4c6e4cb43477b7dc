// SPDX-License-Identifier: MIT
#pragma once

#include "editor/views/inspector/field_rows.h"

namespace sigs::editor {

// Footage, calibration and own-body mask, and what was found in them.
void draw_inputs(const ViewContext& context, FieldRows& rows);

}  // namespace sigs::editor
