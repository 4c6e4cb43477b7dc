// SPDX-License-Identifier: MIT
#pragma once

#include <deque>
#include <string>

#include "editor/document/edits.h"
#include "editor/views/studio.h"

namespace sigs::editor {

// Passing messages at the lower edge of the window. Errors stay until they are clicked.
class Toasts {
 public:
  void say(const Say& said, double now_s);
  void draw(Places& places, double now_s);

  // Whether one will pass by itself: the window has to be drawn again soon.
  [[nodiscard]] bool is_passing() const;

 private:
  struct Toast {
    std::string text;
    bool is_error = false;
    double until_s = 0;
    int times = 1;  // the same was said again
  };
  std::deque<Toast> toasts_;  // oldest first
};

}  // namespace sigs::editor
