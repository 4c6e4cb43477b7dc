// SPDX-License-Identifier: MIT
#pragma once

namespace sigs::editor {

// A window in the middle of the screen that takes all keys and clicks. One at a time: who begins another one replaces
// it, and may begin again once that is gone.
//   width, height  where the text is 15 px high; no larger than the screen; height 0: as its content needs
// True: draw the content, then call end_dialog. closed becomes true with Escape and with the cross in its title.
[[nodiscard]] bool begin_dialog(const char* title, double width, double height, bool& closed);

// stays false: it goes away.
void end_dialog(bool stays);

// A row of buttons at the right edge: call it before the row, with the labels of the row.
void align_buttons_right(const char* const* labels, int count);

// As wide as the widest of a row would like, never smaller than usual.
[[nodiscard]] bool dialog_button(const char* label, bool is_main = false, bool enabled = true);
[[nodiscard]] float dialog_button_width(const char* label);

}  // namespace sigs::editor
