// SPDX-License-Identifier: MIT
#pragma once

#include <imgui.h>

namespace sigs::editor {

// Draws an icon of a side around a centre.
using IconDrawing = void (*)(ImDrawList& draw, ImVec2 center, float side, ImU32 color);

// A button of a toolbar, with an icon, a short label or both.
struct ToolButton {
  const char* id = "";
  IconDrawing icon = nullptr;
  const char* label = "";
  const char* tooltip = "";  // what it does, and its key
  bool on = false;           // highlighted
  bool enabled = true;
};

// As high as a line of text in its frame; true when it is clicked.
bool tool_button(const ToolButton& button);
[[nodiscard]] float tool_button_width(const ToolButton& button);

// A thin upright line between groups of buttons.
void toolbar_gap();
[[nodiscard]] float toolbar_gap_width();

}  // namespace sigs::editor
