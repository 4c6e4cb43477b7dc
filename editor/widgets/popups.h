// SPDX-License-Identifier: MIT
#pragma once

namespace sigs::editor {

// Whether a menu, a list or a dialog is open: keys are meant for it.
[[nodiscard]] bool any_popup_open();

// Escape closes the uppermost menu or list, as people know it; ImGui does so for who walks through it with the keyboard
// alone. Dialogs see to it on their own. Call it once per update, before drawing.
void close_popup_with_escape();

}  // namespace sigs::editor
