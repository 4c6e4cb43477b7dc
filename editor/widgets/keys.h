// SPDX-License-Identifier: MIT
#pragma once

namespace sigs::editor {

// Keys by name, for every version of ImGui: up to 1.86 it counts them as GLFW does, later by names of its own.
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

// Whether the key went down in this update or, with repeats, is held and due again by the keyboard's repeat rate.
[[nodiscard]] bool pressed(Key key, bool repeats = false);
[[nodiscard]] bool held(Key key);

}  // namespace sigs::editor
