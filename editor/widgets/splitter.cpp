// SPDX-License-Identifier: MIT
#include "editor/widgets/splitter.h"

#include <imgui.h>

#include "editor/widgets/theme.h"

namespace sigs::editor {

namespace {

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

float splitter_thickness() {
  return scaled(6);
}

SplitterMove vertical_splitter(const char* id, float length) {
  return splitter(id, {splitter_thickness(), length}, true);
}

SplitterMove horizontal_splitter(const char* id, float length) {
  return splitter(id, {length, splitter_thickness()}, false);
}

}  // namespace sigs::editor
