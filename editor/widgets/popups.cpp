// SPDX-License-Identifier: MIT
#include "editor/widgets/popups.h"

#include <imgui.h>
#include <imgui_internal.h>

#include "editor/widgets/keys.h"

namespace sigs::editor {

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

}  // namespace sigs::editor
