// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "editor/widgets/tool_button.h"

namespace sigs::editor {

// A place in a row of buttons: a button with what it does, a gap, or something else of a width.
struct ToolbarItem {
  ToolButton button;
  std::function<void()> clicked;
  bool is_gap = false;
  float width = 0;                // of something else
  std::function<void()> content;  // draws that
  std::function<void()> drawn;    // after the item was drawn, as ImGui's last one
};

// One row on the panel's colour, as wide as the window: labels where all of them have room, else icons alone where
// there are icons; what has no room then is behind a button at the end.
void draw_toolbar(const std::vector<ToolbarItem>& items);
[[nodiscard]] float toolbar_height();

}  // namespace sigs::editor
