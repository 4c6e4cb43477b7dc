// SPDX-License-Identifier: MIT
#pragma once

namespace sigs::editor {

// Keys by name, for every version of ImGui: up to 1.86 it counts them as GLFW does, later by names of its own. Only
// keys that the editor uses are listed: our name, GLFW's, ImGui's. Letters and signs are places of the US layout, as
// GLFW names them. keypad_enter is another key than enter: what takes one should take both.
#define SIGS_KEYS(KEY)                            \
  KEY(space, SPACE, Space)                        \
  KEY(comma, COMMA, Comma)                        \
  KEY(period, PERIOD, Period)                     \
  KEY(slash, SLASH, Slash)                        \
  KEY(backslash, BACKSLASH, Backslash)            \
  KEY(left_bracket, LEFT_BRACKET, LeftBracket)    \
  KEY(right_bracket, RIGHT_BRACKET, RightBracket) \
  KEY(digit0, 0, 0)                               \
  KEY(digit1, 1, 1)                               \
  KEY(a, A, A)                                    \
  KEY(b, B, B)                                    \
  KEY(c, C, C)                                    \
  KEY(d, D, D)                                    \
  KEY(e, E, E)                                    \
  KEY(f, F, F)                                    \
  KEY(i, I, I)                                    \
  KEY(j, J, J)                                    \
  KEY(k, K, K)                                    \
  KEY(l, L, L)                                    \
  KEY(n, N, N)                                    \
  KEY(o, O, O)                                    \
  KEY(q, Q, Q)                                    \
  KEY(s, S, S)                                    \
  KEY(x, X, X)                                    \
  KEY(y, Y, Y)                                    \
  KEY(z, Z, Z)                                    \
  KEY(left, LEFT, LeftArrow)                      \
  KEY(right, RIGHT, RightArrow)                   \
  KEY(up, UP, UpArrow)                            \
  KEY(down, DOWN, DownArrow)                      \
  KEY(home, HOME, Home)                           \
  KEY(end, END, End)                              \
  KEY(page_up, PAGE_UP, PageUp)                   \
  KEY(page_down, PAGE_DOWN, PageDown)             \
  KEY(enter, ENTER, Enter)                        \
  KEY(keypad_enter, KP_ENTER, KeypadEnter)        \
  KEY(escape, ESCAPE, Escape)                     \
  KEY(insert, INSERT, Insert)                     \
  KEY(del, DELETE, Delete)                        \
  KEY(backspace, BACKSPACE, Backspace)            \
  KEY(f5, F5, F5)                                 \
  KEY(f11, F11, F11)
#define SIGS_KEY_NAME(name, glfw, imgui) name,
enum class Key { SIGS_KEYS(SIGS_KEY_NAME) };
#undef SIGS_KEY_NAME

// Whether the key went down in this update or, with repeats, is held and due again by the keyboard's repeat rate. Says
// nothing of Ctrl, Shift and Alt, nor of who has the keyboard: ImGuiIO does. Between Window::begin() and end() only.
[[nodiscard]] bool pressed(Key key, bool repeats = false);
// Whether either of the two Enter keys went down in this update.
[[nodiscard]] inline bool enter_pressed() {
  return pressed(Key::enter) || pressed(Key::keypad_enter);
}
// Whether the key is down in this update.
[[nodiscard]] bool held(Key key);

}  // namespace sigs::editor
