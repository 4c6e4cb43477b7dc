// SPDX-License-Identifier: MIT
#pragma once

#include <imgui.h>

namespace sigs::editor {

// All icons of the editor. They are drawn from lines, so that no icon font is needed and every size is sharp. An icon
// that is added needs its drawing in the table of icons.cpp.
enum class Icon {
  play,
  pause,
  back,     // one frame
  forward,  // one frame
  to_start,
  to_end,
  loop,
  plus,
  trash,
  copy,
  folder,
  file,
  warning,
  info,
  check,
  cross,
  reset,  // an arrow that turns back
  search,
  settings,
  fit,  // four corners
  aircraft,
  mark_in,   // [
  mark_out,  // ]
  chevron_left,
  box,
  path,
  waypoints,
  horizon,
  own_body,
  grid,
  wipe,
  target,
  brush,
  eraser,
  undo,
  redo,
  orbit,
  view_from_top,
  view_from_side,
  camera,
  fit_contents,  // four corners about a dot
  perspective,
  snap,
  cylinder,
  more,  // three dots
};

// Draws an icon within a square of side `size` (screen pixels) about a centre, which is moved to the middle of its
// pixel. Takes no mouse.
void draw_icon(ImDrawList& list, Icon icon, ImVec2 center, float size, ImU32 color);

// A square on its corner, half of whose diagonals is `radius`; filled, or its outline alone.
void draw_diamond(ImDrawList& list, ImVec2 center, float radius, ImU32 color);
void draw_diamond(ImDrawList& list, ImVec2 center, float radius, ImU32 color, float line_width);

// A square button at the cursor, as high as a line of controls; true when clicked.
//   id       names it within the ImGui window; not shown
//   tooltip  may be ""
//   on       drawn as switched on
[[nodiscard]] bool icon_button(const char* id, Icon icon, const char* tooltip, bool on = false);
// Its side, in screen pixels.
[[nodiscard]] float icon_button_width();

// An icon of the text's size at the cursor, as an item of its own.
void icon_label(Icon icon, ImU32 color);

// For the item that ImGui drew last, once the mouse has rested on it for a moment; wrapped where it is long. "": none.
void tooltip_for_item(const char* text);

// The same for tooltips that are more than text: true once the mouse has rested, in every update until it leaves.
[[nodiscard]] bool item_wants_tooltip();

}  // namespace sigs::editor
