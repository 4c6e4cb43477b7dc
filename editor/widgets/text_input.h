// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>

namespace sigs::editor {

// What can be typed or pasted into one line, in bytes: as long as the longest path that Linux knows. More is refused
// as it comes.
constexpr std::size_t kMaxTypedText = 4095;

// ImGui's line of text for a string. One that is longer than can be typed is shown cut where the hint is: what is typed
// takes its place as a whole.
//   hint   shown where it is empty; "" for none
//   flags  ImGuiInputTextFlags
bool text_input(const char* label, std::string& text, const char* hint = "", int flags = 0);

}  // namespace sigs::editor
