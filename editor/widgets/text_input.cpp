// SPDX-License-Identifier: MIT
#include "editor/widgets/text_input.h"

#include <imgui.h>

#include <algorithm>
#include <array>

#include "editor/widgets/elided.h"

namespace sigs::editor {

bool text_input(const char* label, std::string& text, const char* hint, int flags) {
  const bool is_too_long = text.size() > kMaxTypedText;
  std::array<char, kMaxTypedText + 1> typed{};
  if (!is_too_long) std::copy(text.begin(), text.end(), typed.begin());
  const std::string shown = is_too_long ? shortened(text, 200) : std::string(hint);
  const bool answer = ImGui::InputTextWithHint(label, shown.c_str(), typed.data(), typed.size(), flags);
  if (!is_too_long || typed[0] != '\0') text = typed.data();
  return answer;
}

}  // namespace sigs::editor
