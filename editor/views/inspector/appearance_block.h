// SPDX-License-Identifier: MIT
#pragma once

#include "editor/views/context.h"
#include "editor/views/inspector/field_rows.h"

namespace sigs::editor {

// How the footage looks: its settings, the button that finds them, and what it has found, each with its deviation.
void draw_appearance(const ViewContext& context, FieldRows& rows);

}  // namespace sigs::editor
