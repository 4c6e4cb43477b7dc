// SPDX-License-Identifier: MIT
#pragma once

#include "editor/views/context.h"

namespace sigs::editor {

// The results of trackers that are loaded: which colour is whose, what they come to, and what they are measured by.
// Nothing while none are.
void draw_results_panel(const ViewContext& context);

}  // namespace sigs::editor
