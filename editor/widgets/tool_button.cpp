// SPDX-License-Identifier: MIT
#include "editor/widgets/tool_button.h"

#include <cmath>

#include "editor/widgets/icons.h"
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
  if (button.icon != nullptr) {
    const ImVec2 center(std::round(x + side / 2), std::round(low.y + size.y / 2));
    button.icon(draw, center, side, button.on ? color::kAccent : ink);
    x += side + scaled(5);
  }
  if (button.label[0] != 0) draw.AddText({std::round(x), std::round(low.y + (size.y - side) / 2)}, ink, button.label);
}

}  // namespace

float tool_button_width(const ToolButton& button) {
  const float icon = button.icon != nullptr ? ImGui::GetFontSize() : 0;
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

}  // namespace sigs::editor
