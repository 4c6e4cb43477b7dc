// SPDX-License-Identifier: MIT
#include "editor/widgets/icons.h"

#include <imgui_internal.h>

#include "editor/widgets/elided.h"
#include "editor/widgets/icon_shapes.h"
#include "editor/widgets/theme.h"

namespace sigs::editor {

namespace {

constexpr float kRestBeforeTooltip_s = 0.35F;

// The side of an icon within a button of some height.
float icon_size() {
  return ImGui::GetFontSize() * 1.1F;
}

}  // namespace

float icon_button_width() {
  return ImGui::GetFrameHeight();
}

bool icon_button(const char* id, Icon icon, const char* tooltip, bool on) {
  const float side = icon_button_width();
  ImGui::PushStyleColor(ImGuiCol_Button, on ? color::kAccentSoft : IM_COL32_BLACK_TRANS);
  ImGui::PushID(id);
  const bool clicked = ImGui::Button("##icon", {side, side});
  ImGui::PopID();
  ImGui::PopStyleColor();
  const ImVec2 low = ImGui::GetItemRectMin();
  const ImVec2 center{low.x + side / 2, low.y + side / 2};
  const ImU32 shade = ImGui::GetColorU32(on ? color::kAccent : color::kText);  // paler where disabled
  draw_icon(*ImGui::GetWindowDrawList(), icon, center, icon_size(), shade);
  tooltip_for_item(tooltip);
  return clicked;
}

void icon_label(Icon icon, ImU32 color) {
  const float side = ImGui::GetFontSize();
  const ImVec2 low = ImGui::GetCursorScreenPos();
  ImGui::Dummy({side, side});
  draw_icon(*ImGui::GetWindowDrawList(), icon, {low.x + side / 2, low.y + side / 2}, side, ImGui::GetColorU32(color));
}

bool item_wants_tooltip() {
  return ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled) &&
         ImGui::GetCurrentContext()->HoveredIdTimer >= kRestBeforeTooltip_s;
}

void tooltip_for_item(const char* text) {
  if (*text == '\0' || !item_wants_tooltip()) return;
  ImGui::BeginTooltip();
  ImGui::PushTextWrapPos(ImGui::GetFontSize() * 26);
  ImGui::TextUnformatted(shortened(text).c_str());
  ImGui::PopTextWrapPos();
  ImGui::EndTooltip();
}

}  // namespace sigs::editor
