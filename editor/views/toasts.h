// SPDX-License-Identifier: MIT
#pragma once

#include <imgui.h>

#include <cstddef>
#include <deque>
#include <string>

#include "editor/document/document.h"
#include "editor/views/context.h"

namespace sigs::editor {

// Passing messages, above the timeline. Errors stay longer, and as long as the mouse is over one; a click takes any
// away.
class Toasts {
 public:
  // A message that is shown already counts up instead of appearing twice. now_s: seconds of a steady clock, in all
  // calls.
  void show(const ShowMessage& shown_message, double now_s);
  // foot: the middle of the lowest one's lower edge; width_px: room from left to right.
  void draw(UiProbe& ui_probe, double now_s, ImVec2 foot, float width_px);
  // Another project is open: they would speak of one that is not.
  void clear() { toasts_.clear(); }

  // Whether one will pass by itself: the window has to be drawn again soon.
  [[nodiscard]] bool is_passing() const { return !toasts_.empty(); }

  // Of messages that are shown.
  [[nodiscard]] std::size_t count() const { return toasts_.size(); }
  // Takes away those whose time is over; draw() does so too.
  void pass(double now_s);

 private:
  struct Toast {
    std::string text;
    bool is_error = false;
    // When its time is over.
    double until_s = 0;
    int times = 1;  // how often the same message came
  };
  std::deque<Toast> toasts_;  // oldest first
};

}  // namespace sigs::editor
