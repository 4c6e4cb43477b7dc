// SPDX-License-Identifier: MIT
#include "editor/widgets/popup.h"

#include <imgui.h>

#include "editor/widgets/keys.h"

namespace sigs::editor {

void close_by_escape() {
  if (ImGui::IsWindowFocused(ImGuiFocusedFlags_RootAndChildWindows) && released(Key::escape))
    ImGui::CloseCurrentPopup();
}

}  // namespace sigs::editor
