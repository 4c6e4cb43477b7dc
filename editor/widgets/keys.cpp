// SPDX-License-Identifier: MIT
#include "editor/widgets/keys.h"

#include <imgui.h>

#include <array>

#if IMGUI_VERSION_NUM < 18700
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#define SIGS_KEY_CODE(name, glfw, imgui) GLFW_KEY_##glfw,
#else
#define SIGS_KEY_CODE(name, glfw, imgui) ImGuiKey_##imgui,
#endif

namespace sigs::editor {

namespace {

// In the order of Key.
constexpr std::array kCodes{SIGS_KEYS(SIGS_KEY_CODE)};

}  // namespace

bool pressed(Key key, bool repeats) {
  return ImGui::IsKeyPressed(kCodes[static_cast<std::size_t>(key)], repeats);
}

bool held(Key key) {
  return ImGui::IsKeyDown(kCodes[static_cast<std::size_t>(key)]);
}

}  // namespace sigs::editor
