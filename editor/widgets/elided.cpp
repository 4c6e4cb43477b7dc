// SPDX-License-Identifier: MIT
#include "editor/widgets/elided.h"

#include <imgui.h>

namespace sigs::editor {

namespace {

float width_of(const std::string& text) {
  return ImGui::CalcTextSize(text.c_str(), text.c_str() + text.size()).x;
}

// Not between the bytes of one UTF-8 character.
std::size_t whole_characters(const std::string& text, std::size_t bytes) {
  while (bytes > 0 && bytes < text.size() && (static_cast<unsigned char>(text[bytes]) & 0xC0U) == 0x80U) --bytes;
  return bytes;
}

}  // namespace

std::string elided(const std::string& text, float width) {
  if (width_of(text) <= width) return text;
  std::size_t fits = 0;
  std::size_t too_many = text.size();
  while (too_many - fits > 1) {
    const std::size_t half = (fits + too_many) / 2;
    const bool enough = width_of(text.substr(0, whole_characters(text, half)) + "...") <= width;
    (enough ? fits : too_many) = half;
  }
  if (fits == 0) return {};
  return text.substr(0, whole_characters(text, fits)) + "...";
}

}  // namespace sigs::editor
