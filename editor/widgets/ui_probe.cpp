// SPDX-License-Identifier: MIT
#include "editor/widgets/ui_probe.h"

#include <imgui.h>

namespace sigs::editor {

void UiProbe::note_item(const std::string& name) {
  const ImVec2 low = ImGui::GetItemRectMin();
  const ImVec2 high = ImGui::GetItemRectMax();
  note(name, {{low.x, low.y}, {high.x, high.y}});
}

}  // namespace sigs::editor
