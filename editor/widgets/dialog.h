// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

namespace sigs::editor {

// A window in the middle of the screen that takes all keys and clicks. One at a time: who begins another one replaces
// it, and may begin again once that is gone.
//   width, height  where the text is 15 px high; no larger than the screen; height 0: as its content needs
// True: draw the content, then call end_dialog. closed becomes true with Escape and with the cross in its title.
[[nodiscard]] bool begin_dialog(const char* title, double width, double height, bool& closed);

// stays false: it goes away.
void end_dialog(bool stays);

// A row of buttons at the right edge: call it before the row, with the labels of the row.
void align_buttons_right(const std::vector<const char*>& labels);

// width: in screen pixels; -1: all that there is, 0: as its label needs, never smaller than usual.
[[nodiscard]] bool dialog_button(const char* label, bool is_main = false, bool enabled = true, float width = 0);
[[nodiscard]] float dialog_button_width(const char* label);
// Of a row of buttons, with the room above it.
[[nodiscard]] float dialog_buttons_height();

// Begins a row of a table of two columns: a label with its tooltip in the first; the setting comes into the second.
void begin_setting(const char* label, const char* help = "");

// Whether a menu, a list or a dialog is open: keys are meant for it.
[[nodiscard]] bool any_popup_open();

// Escape closes the uppermost menu or list, as people know it; ImGui does so for who walks through it with the keyboard
// alone. Dialogs see to it on their own. Call it once per update, before drawing.
void close_popup_with_escape();

// A bar between two panels that is dragged with the mouse; a double click asks for the usual size. Drawn at the current
// cursor place, `length` long.
struct SplitterMove {
  double by_px = 0;
  bool reset = false;
};
[[nodiscard]] SplitterMove vertical_splitter(const char* id, float length);    // left | right
[[nodiscard]] SplitterMove horizontal_splitter(const char* id, float length);  // upper / lower
[[nodiscard]] float splitter_thickness();

// Before a tooltip for the item that ImGui drew last: beside the panel or dialog, level with the item, so that the rows
// below it stay in sight. In wide windows, and where there is no room, it comes where ImGui has it: at the mouse.
//   width  of the tooltip, screen pixels
void place_tooltip_beside_panel(float width);

}  // namespace sigs::editor
