// SPDX-License-Identifier: MIT
#include "editor/widgets/toolbar.h"

#include <algorithm>
#include <cmath>
#include <span>

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
  if (item.drawn) item.drawn();
}

std::vector<ToolbarItem> without_labels(std::vector<ToolbarItem> items) {
  for (ToolbarItem& item : items)
    if (item.button.icon != nullptr) item.button.label = "";
  return items;
}

void draw_dots(ImDrawList& draw, ImVec2 center, float side, ImU32 color) {
  for (const float x : {-0.3F, 0.0F, 0.3F})
    draw.AddCircleFilled({center.x + x * side, center.y}, side * 0.09F, color, 8);
}

constexpr ToolButton kMore{.id = "more", .icon = draw_dots, .tooltip = "What has no room here"};

// Before the button for the rest, where not all of them do.
std::size_t how_many_fit(const std::vector<ToolbarItem>& items, float room) {
  if (width_of(items) - spacing() <= room) return items.size();
  room -= tool_button_width(kMore) + spacing();
  std::size_t count = 0;
  for (float x = 0; count < items.size() && x + width_of(items[count]) <= room; ++count)
    x += width_of(items[count]) + spacing();
  return count;
}

// One below the other.
void draw_rest(std::span<const ToolbarItem> rest) {
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {scaled(8), scaled(5)});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {scaled(8), scaled(8)});
  if (ImGui::BeginPopup(kMore.id)) {
    if (rest.empty()) ImGui::CloseCurrentPopup();
    for (const ToolbarItem& item : rest)
      if (!item.is_gap) draw_item(item);
    ImGui::EndPopup();
  }
  ImGui::PopStyleVar(2);
}

}  // namespace

float toolbar_height() {
  return std::ceil(ImGui::GetFrameHeight() + scaled(8));
}

void draw_toolbar(const std::vector<ToolbarItem>& items) {
  const ImVec2 low = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x;
  ImGui::GetWindowDrawList()->AddRectFilled(low, {low.x + width, low.y + toolbar_height()}, color::kPanel);
  const float margin = scaled(6);
  const float room = width - 2 * margin;
  const auto put_cursor = [&](float x) {
    ImGui::SetCursorScreenPos({std::round(low.x + margin + x), std::round(low.y + scaled(4))});
  };
  const std::vector<ToolbarItem> shown = width_of(items) > room ? without_labels(items) : items;
  const std::size_t count = how_many_fit(shown, room);
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {spacing(), 0});
  float x = 0;
  for (std::size_t i = 0; i < count; ++i) {
    put_cursor(x);
    draw_item(shown[i]);
    x += width_of(shown[i]) + spacing();
  }
  if (count < items.size()) {
    put_cursor(std::max(0.0F, std::min(x, room - tool_button_width(kMore))));
    if (tool_button(kMore)) ImGui::OpenPopup(kMore.id);
  }
  ImGui::PopStyleVar();
  draw_rest(std::span(items).subspan(count));
  ImGui::SetCursorScreenPos({low.x, low.y + toolbar_height()});
}

}  // namespace sigs::editor
