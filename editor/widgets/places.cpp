// SPDX-License-Identifier: MIT
#include "editor/widgets/places.h"

#include <imgui.h>

namespace sigs::editor {

void Places::note_item(const std::string& name) {
  const ImVec2 low = ImGui::GetItemRectMin();
  const ImVec2 high = ImGui::GetItemRectMax();
  note(name, {{low.x, low.y}, {high.x, high.y}});
}

}  // namespace sigs::editor
