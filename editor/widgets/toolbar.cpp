// SPDX-License-Identifier: MIT
#include "editor/widgets/toolbar.h"

#include <cmath>

#include "editor/widgets/theme.h"

namespace sigs::editor {

namespace {

float spacing() {
  return scaled(2);
}

float width_of(const ToolbarItem& item) {
  if (item.is_gap) return toolbar_gap_width();
  return item.content ? item.width : tool_button_width(item.button);
}

float width_of(const std::vector<ToolbarItem>& items) {
  float width = 0;
  for (const ToolbarItem& item : items) width += width_of(item) + spacing();
  return width;
}

void draw_item(const ToolbarItem& item) {
  if (item.is_gap)
    toolbar_gap();
  else if (item.content)
    item.content();
  else if (tool_button(item.button) && item.clicked)
    item.clicked();
}

}  // namespace

float toolbar_height() {
  return std::ceil(ImGui::GetFrameHeight() + scaled(8));
}

void draw_toolbar(std::vector<ToolbarItem> items) {
  const ImVec2 low = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x;
  ImGui::GetWindowDrawList()->AddRectFilled(low, {low.x + width, low.y + toolbar_height()}, color::kPanel);
  const float margin = scaled(6);
  const float room = width - 2 * margin;
  if (width_of(items) > room)
    for (ToolbarItem& item : items)
      if (item.button.icon != nullptr) item.button.label = "";
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {spacing(), 0});
  float x = 0;
  for (const ToolbarItem& item : items) {
    if (x + width_of(item) > room) break;
    ImGui::SetCursorScreenPos({std::round(low.x + margin + x), std::round(low.y + scaled(4))});
    draw_item(item);
    x += width_of(item) + spacing();
  }
  ImGui::PopStyleVar();
  ImGui::SetCursorScreenPos({low.x, low.y + toolbar_height()});
}

}  // namespace sigs::editor
