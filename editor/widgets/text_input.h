// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace sigs::editor {

// ImGui's line of text for a string of any length.
//   hint   shown where it is empty; "" for none
//   flags  ImGuiInputTextFlags
bool text_input(const char* label, std::string& text, const char* hint = "", int flags = 0);

}  // namespace sigs::editor
