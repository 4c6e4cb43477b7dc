// SPDX-License-Identifier: MIT
#pragma once

namespace sigs::editor {

// Keys by name, for every version of ImGui: up to 1.86 it counts them as GLFW does, later by names of its own. Only
// keys that the editor uses are listed. Letters and signs are places of the US layout, as GLFW names them. A key that
// is added needs a line at the same place in the table of keys.cpp.
enum class Key {
  space,
  comma,
  period,
  slash,
  backslash,
  left_bracket,
  right_bracket,
  digit0,
  digit1,
  a,
  b,
  c,
  d,
  e,
  f,
  i,
  j,
  k,
  l,
  n,
  o,
  q,
  r,
  s,
  x,
  y,
  z,
  left,
  right,
  up,
  down,
  home,
  end,
  page_up,
  page_down,
  enter,
  // Another key than enter: what takes one should take both.
  keypad_enter,
  escape,
  tab,
  insert,
  del,
  backspace,
  f2,
  f5,
  f11,
};

// Whether the key went down in this update or, with repeats, is held and due again by the keyboard's repeat rate. Says
// nothing of Ctrl, Shift and Alt, nor of who has the keyboard: ImGuiIO does. Between Window::begin() and end() only.
[[nodiscard]] bool pressed(Key key, bool repeats = false);
// Whether the key is down in this update.
[[nodiscard]] bool held(Key key);

}  // namespace sigs::editor
