// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <string>

#include "editor/geometry/picture_view.h"

namespace sigs::editor {

// Where things with a name lie on the screen in this turn, so that whoever drives the window from outside (a test, a
// guided tour) finds them. Costs nothing while nobody asks.
class Places {
 public:
  void note(const std::string& name, const ScreenRect& rect) {
    if (wanted_) places_[name] = rect;
  }
  // The item that ImGui drew last.
  void note_item(const std::string& name);

  void set_wanted(bool wanted) { wanted_ = wanted; }
  [[nodiscard]] bool wanted() const { return wanted_; }
  [[nodiscard]] const std::map<std::string, ScreenRect>& all() const { return places_; }
  void clear() { places_.clear(); }

 private:
  std::map<std::string, ScreenRect> places_;
  bool wanted_ = false;
};

}  // namespace sigs::editor
