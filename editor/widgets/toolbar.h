// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "editor/widgets/icons.h"

namespace sigs::editor {

// A button of a toolbar, with an icon, a short label or both. The texts are not copied: use literals, or strings that
// live until it is drawn.
struct ToolButton {
  // Names it within the ImGui window; not shown.
  const char* id = "";
  std::optional<Icon> icon;
  const char* label = "";
  // What it does, and its key.
  const char* tooltip = "";
  bool on = false;  // highlighted
  bool enabled = true;
};

// One item of a toolbar: a button, a gap (a thin line between groups of buttons), or any other content of a given
// width. A toolbar is a list of items that is made anew in each update.
struct ToolbarItem {
  ToolButton button;
  // Called while drawing, after a click on the button; may be empty.
  std::function<void()> clicked;
  bool is_gap = false;
  float width = 0;  // of the other content, in screen pixels
  // Draws the other content at the cursor; empty: the item is a button or a gap.
  std::function<void()> content;
  // Called after the item was drawn, while it is ImGui's last item: to note its place for tests, for example.
  std::function<void()> drawn;
};

// A button that is on while a setting is on; a click switches it. The setting must live until the toolbar is drawn.
[[nodiscard]] inline ToolbarItem toggle_item(ToolButton button, bool& setting) {
  button.on = setting;
  return {.button = button, .clicked = [&setting] { setting = !setting; }};
}

// One of several choices: on while `value` is `choice`; a click sets it and then calls `then`. The value must live
// until the toolbar is drawn.
template <class Value>
[[nodiscard]] ToolbarItem choice_item(ToolButton button, Value& value, Value choice, std::function<void()> then = {}) {
  button.on = value == choice;
  return {.button = button, .clicked = [&value, choice, then = std::move(then)] {
            value = choice;
            if (then) then();
          }};
}

// The buttons "Fit" and "1:1" of an image that is zoomed and panned, on while it is fitted or shown pixel by pixel.
struct ZoomChoice {
  bool is_fitted = false;
  // Screen pixels for each pixel of the image.
  double zoom = 1;
  std::function<void()> fit;
  std::function<void()> to_exact;
};
// Appends both buttons.
void add_zoom_items(std::vector<ToolbarItem>& items, const ZoomChoice& zoom);

// Draws a row of items on the panel's colour at the cursor, as wide as the window. Where the items are too wide
// together, buttons with an icon lose their label; items that still do not fit are in a popup behind a button at the
// end.
void draw_toolbar(const std::vector<ToolbarItem>& items);
[[nodiscard]] float toolbar_height();

}  // namespace sigs::editor
