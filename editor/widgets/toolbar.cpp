// SPDX-License-Identifier: MIT
#include "editor/widgets/toolbar.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "editor/widgets/theme.h"

namespace sigs::editor {

namespace {

float padding() {
  return scaled(6);
}

ImU32 background_of(const ToolButton& button, bool hovered, bool held) {
  if (held) return faded(color::kAccent, 0.45);
  if (button.on) return faded(color::kAccent, hovered ? 0.36 : 0.24);
  return hovered ? IM_COL32(255, 255, 255, 26) : IM_COL32_BLACK_TRANS;
}

ImU32 ink_of(const ToolButton& button, bool hovered) {
  if (!button.enabled) return faded(color::kQuiet, 0.45);
  return button.on || hovered ? color::kText : color::kQuiet;
}

void draw_face(const ToolButton& button, ImVec2 low, ImVec2 size, bool hovered, bool held) {
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  draw.AddRectFilled(low, {low.x + size.x, low.y + size.y}, background_of(button, hovered, held), scaled(4));
  const ImU32 ink = ink_of(button, hovered);
  const float side = ImGui::GetFontSize();
  float x = low.x + padding();
  if (button.icon) {
    const ImVec2 center(std::round(x + side / 2), std::round(low.y + size.y / 2));
    draw_icon(draw, *button.icon, center, side, button.on ? color::kAccent : ink);
    x += side + scaled(5);
  }
  if (button.label[0] != 0) draw.AddText({std::round(x), std::round(low.y + (size.y - side) / 2)}, ink, button.label);
}

float tool_button_width(const ToolButton& button) {
  const float icon = button.icon ? ImGui::GetFontSize() : 0;
  const float label = button.label[0] != 0 ? ImGui::CalcTextSize(button.label).x : 0;
  const float gap = icon > 0 && label > 0 ? scaled(5) : 0;
  return std::ceil(icon + gap + label + 2 * padding());
}

bool tool_button(const ToolButton& button) {
  const ImVec2 size(tool_button_width(button), ImGui::GetFrameHeight());
  const ImVec2 low = ImGui::GetCursorScreenPos();
  if (!button.enabled) ImGui::BeginDisabled();
  const bool clicked = ImGui::InvisibleButton(button.id, size);
  const bool hovered = button.enabled && ImGui::IsItemHovered();
  const bool held = ImGui::IsItemActive();
  if (!button.enabled) ImGui::EndDisabled();
  draw_face(button, low, size, hovered, held);
  if (!held) tooltip_for_item(button.tooltip);
  return clicked;
}

float toolbar_gap_width() {
  return scaled(13);
}

void toolbar_gap() {
  const ImVec2 low = ImGui::GetCursorScreenPos();
  const float height = ImGui::GetFrameHeight();
  const float x = std::round(low.x + toolbar_gap_width() / 2);
  ImGui::GetWindowDrawList()->AddRectFilled({x, low.y + height * 0.2F}, {x + 1, low.y + height * 0.8F}, color::kFaint);
  ImGui::Dummy({toolbar_gap_width(), height});
}

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
    if (item.button.icon) item.button.label = "";
  return items;
}

constexpr ToolButton kMore{.id = "more", .icon = Icon::more, .tooltip = "What has no room here"};

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

void add_zoom_items(std::vector<ToolbarItem>& items, const ZoomChoice& zoom) {
  items.push_back({.button = {.id = "fit",
                              .icon = Icon::fit_contents,
                              .label = "Fit",
                              .tooltip = "The whole image (F or 0)",
                              .on = zoom.is_fitted},
                   .clicked = zoom.fit});
  items.push_back({.button = {.id = "exact",
                              .label = "1:1",
                              .tooltip = "One pixel of the screen for each of the image (1)",
                              .on = zoom.zoom == 1},
                   .clicked = zoom.to_exact});
}

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
