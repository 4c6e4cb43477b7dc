// SPDX-License-Identifier: MIT
#include "editor/widgets/ui_probe.h"

#include <imgui.h>

#include "editor/widgets/icons.h"

namespace sigs::editor {

void UiProbe::note_item(const std::string& name, const std::string& tooltip) {
  const ImVec2 low = ImGui::GetItemRectMin();
  const ImVec2 high = ImGui::GetItemRectMax();
  note(name, {{low.x, low.y}, {high.x, high.y}});
  tooltip_for_item(tooltip.c_str());
}

}  // namespace sigs::editor
