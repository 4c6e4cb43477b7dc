// SPDX-License-Identifier: MIT
#include "editor/widgets/keys.h"

#include <imgui.h>

#include <array>

#if IMGUI_VERSION_NUM < 18700
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#define SIGS_KEY(glfw, imgui) GLFW_KEY_##glfw
#else
#define SIGS_KEY(glfw, imgui) ImGuiKey_##imgui
#endif

namespace sigs::editor {

namespace {

// In the order of Key.
constexpr std::array kCodes{
    SIGS_KEY(SPACE, Space),
    SIGS_KEY(COMMA, Comma),
    SIGS_KEY(PERIOD, Period),
    SIGS_KEY(SLASH, Slash),
    SIGS_KEY(BACKSLASH, Backslash),
    SIGS_KEY(LEFT_BRACKET, LeftBracket),
    SIGS_KEY(RIGHT_BRACKET, RightBracket),
    SIGS_KEY(0, 0),
    SIGS_KEY(1, 1),
    SIGS_KEY(A, A),
    SIGS_KEY(B, B),
    SIGS_KEY(C, C),
    SIGS_KEY(D, D),
    SIGS_KEY(E, E),
    SIGS_KEY(F, F),
    SIGS_KEY(I, I),
    SIGS_KEY(J, J),
    SIGS_KEY(K, K),
    SIGS_KEY(L, L),
    SIGS_KEY(N, N),
    SIGS_KEY(O, O),
    SIGS_KEY(Q, Q),
    SIGS_KEY(R, R),
    SIGS_KEY(S, S),
    SIGS_KEY(X, X),
    SIGS_KEY(Y, Y),
    SIGS_KEY(Z, Z),
    SIGS_KEY(LEFT, LeftArrow),
    SIGS_KEY(RIGHT, RightArrow),
    SIGS_KEY(UP, UpArrow),
    SIGS_KEY(DOWN, DownArrow),
    SIGS_KEY(HOME, Home),
    SIGS_KEY(END, End),
    SIGS_KEY(PAGE_UP, PageUp),
    SIGS_KEY(PAGE_DOWN, PageDown),
    SIGS_KEY(ENTER, Enter),
    SIGS_KEY(KP_ENTER, KeypadEnter),
    SIGS_KEY(ESCAPE, Escape),
    SIGS_KEY(TAB, Tab),
    SIGS_KEY(INSERT, Insert),
    SIGS_KEY(DELETE, Delete),
    SIGS_KEY(BACKSPACE, Backspace),
    SIGS_KEY(F2, F2),
    SIGS_KEY(F5, F5),
    SIGS_KEY(F11, F11),
};
static_assert(kCodes.size() == static_cast<std::size_t>(Key::f11) + 1);

}  // namespace

bool pressed(Key key, bool repeats) {
  return ImGui::IsKeyPressed(kCodes[static_cast<std::size_t>(key)], repeats);
}

bool held(Key key) {
  return ImGui::IsKeyDown(kCodes[static_cast<std::size_t>(key)]);
}

}  // namespace sigs::editor
