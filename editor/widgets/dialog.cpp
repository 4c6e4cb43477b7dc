// SPDX-License-Identifier: MIT
#include "editor/widgets/dialog.h"

#include <imgui_internal.h>

#include <algorithm>

#include "editor/widgets/icons.h"
#include "editor/widgets/keys.h"
#include "editor/widgets/theme.h"

namespace sigs::editor {

namespace {

// In the middle of the screen when the dialog appears; then it stays, so that what is pressed does not move away where
// the dialog grows, unless it would leave the screen.
float upper_edge(const char* title, float margin) {
  const ImGuiViewport& screen = *ImGui::GetMainViewport();
  ImGuiWindow* const window = ImGui::FindWindowByName(title);
  if (window == nullptr) return screen.Pos.y + screen.Size.y / 3;
  // ImGui takes some updates to find how high it is.
  constexpr int kUpdatesToMeasure = 5;
  int& updates = *window->StateStorage.GetIntRef(ImHashStr("updates"));
  const bool was_drawn = ImGui::GetFrameCount() - window->LastFrameActive <= 1;
  updates = was_drawn ? std::min(updates + 1, kUpdatesToMeasure) : 0;
  if (updates < kUpdatesToMeasure) return screen.Pos.y + (screen.Size.y - window->Size.y) / 2;
  return std::max(screen.Pos.y + margin,
                  std::min(window->Pos.y, screen.Pos.y + screen.Size.y - margin - window->Size.y));
}

SplitterMove splitter(const char* id, ImVec2 size, bool upright) {
  ImGui::InvisibleButton(id, size);
  const bool hot = ImGui::IsItemHovered() || ImGui::IsItemActive();
  if (hot) {
    ImGui::SetMouseCursor(upright ? ImGuiMouseCursor_ResizeEW : ImGuiMouseCursor_ResizeNS);
    const ImVec2 low = ImGui::GetItemRectMin();
    const ImVec2 high = ImGui::GetItemRectMax();
    const float inset = scaled(2);
    const ImVec2 a = upright ? ImVec2(low.x + inset, low.y) : ImVec2(low.x, low.y + inset);
    const ImVec2 b = upright ? ImVec2(high.x - inset, high.y) : ImVec2(high.x, high.y - inset);
    ImGui::GetWindowDrawList()->AddRectFilled(a, b, color::kAccentSoft);
  }
  SplitterMove move;
  if (ImGui::IsItemActive()) move.by_px = upright ? ImGui::GetIO().MouseDelta.x : ImGui::GetIO().MouseDelta.y;
  move.reset = ImGui::IsItemHovered() && ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left);
  return move;
}

}  // namespace

bool begin_dialog(const char* title, double width, double height, bool& closed) {
  const ImGuiViewport& screen = *ImGui::GetMainViewport();
  const float margin = scaled(16);
  const float w = std::min(scaled(width), screen.Size.x - 2 * margin);
  const float h = std::min(scaled(height), screen.Size.y - 2 * margin);
  if (!ImGui::IsPopupOpen(title)) ImGui::OpenPopup(title);
  ImGui::SetNextWindowPos({screen.Pos.x + screen.Size.x / 2, upper_edge(title, margin)}, ImGuiCond_Always,
                          {0.5F, 0.0F});
  if (height > 0)
    ImGui::SetNextWindowSize({w, h});
  else
    ImGui::SetNextWindowSizeConstraints({w, 0}, {w, screen.Size.y - 2 * margin});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {scaled(16), scaled(14)});
  bool open = true;
  const int fitted = height > 0 ? 0 : ImGuiWindowFlags_AlwaysAutoResize;
  const bool drawn = ImGui::BeginPopupModal(
      title, &open, ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings | fitted);
  ImGui::PopStyleVar();
  if (!drawn) {
    closed = closed || !open;
    return false;
  }
  // Escape first takes back what is being typed, dragged or chosen; in a text that was not changed it closes at once.
  const ImGuiContext& gui = *ImGui::GetCurrentContext();
  const bool is_at_work = ImGui::IsAnyItemActive() && (gui.ActiveIdHasBeenEditedBefore || gui.TempInputId != 0 ||
                                                       gui.ActiveId != gui.InputTextState.ID);
  if (!open || (pressed(Key::escape) && !is_at_work)) closed = true;
  return true;
}

void end_dialog(bool stays) {
  if (!stays) ImGui::CloseCurrentPopup();
  ImGui::EndPopup();
}

float dialog_button_width(const char* label) {
  return std::max(scaled(86),
                  ImGui::CalcTextSize(label, nullptr, true).x + 2 * ImGui::GetStyle().FramePadding.x + scaled(12));
}

void align_buttons_right(const std::vector<const char*>& labels) {
  float width = ImGui::GetStyle().ItemSpacing.x * static_cast<float>(std::max(0, static_cast<int>(labels.size()) - 1));
  for (const char* const label : labels) width += dialog_button_width(label);
  const float room = ImGui::GetContentRegionAvail().x;
  if (room > width) ImGui::SetCursorPosX(ImGui::GetCursorPosX() + room - width);
}

float dialog_buttons_height() {
  return scaled(28) + scaled(6) + 2 * ImGui::GetStyle().ItemSpacing.y;
}

bool dialog_button(const char* label, bool is_main, bool enabled, float width) {
  ImGui::BeginDisabled(!enabled);
  if (is_main) {
    ImGui::PushStyleColor(ImGuiCol_Button, IM_COL32(40, 98, 165, 255));
    ImGui::PushStyleColor(ImGuiCol_ButtonHovered, IM_COL32(52, 118, 194, 255));
  }
  const bool clicked = ImGui::Button(label, {width != 0 ? width : dialog_button_width(label), scaled(28)});
  if (is_main) ImGui::PopStyleColor(2);
  ImGui::EndDisabled();
  return clicked && enabled;
}

void begin_setting(const char* label, const char* help) {
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted(label);
  tooltip_for_item(help);
  ImGui::TableNextColumn();
}

bool any_popup_open() {
  return ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopupId);
}

void close_popup_with_escape() {
  const ImVector<ImGuiPopupData>& open = ImGui::GetCurrentContext()->OpenPopupStack;
  if (open.empty() || !pressed(Key::escape) || ImGui::IsAnyItemActive()) return;
  const ImGuiWindow* const uppermost = open.back().Window;
  if (uppermost == nullptr || (uppermost->Flags & ImGuiWindowFlags_Modal) != 0) return;
  ImGui::ClosePopupToLevel(open.Size - 1, true);
}

float splitter_thickness() {
  return scaled(6);
}

SplitterMove vertical_splitter(const char* id, float length) {
  return splitter(id, {splitter_thickness(), length}, true);
}

SplitterMove horizontal_splitter(const char* id, float length) {
  return splitter(id, {length, splitter_thickness()}, false);
}

void place_tooltip_beside_panel(float width) {
  const ImGuiViewport& screen = *ImGui::GetMainViewport();
  const ImVec2 low = ImGui::GetWindowPos();
  const float right = low.x + ImGui::GetWindowSize().x;
  if (ImGui::GetWindowSize().x > 0.55F * screen.Size.x) return;
  const float gap = scaled(8);
  const float y = ImGui::GetItemRectMin().y;
  if (low.x - screen.Pos.x >= width + gap)
    ImGui::SetNextWindowPos({low.x - gap, y}, ImGuiCond_Always, {1, 0});
  else if (screen.Pos.x + screen.Size.x - right >= width + gap)
    ImGui::SetNextWindowPos({right + gap, y}, ImGuiCond_Always);
}

}  // namespace sigs::editor
