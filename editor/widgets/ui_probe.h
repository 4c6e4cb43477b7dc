// SPDX-License-Identifier: MIT
#pragma once

#include <imgui.h>

#include <map>
#include <string>

#include "editor/geometry/image_view.h"
#include "editor/widgets/icons.h"

namespace sigs::editor {

// Where things with a name lie on the screen in this update, so that whoever drives the window from outside (a test, a
// guided tour) finds them. Costs nothing while nobody asks. Names are like "own body/detect"; the last note of a name
// counts.
class UiProbe {
 public:
  // rect: in ImGui's screen coordinates.
  void note(const std::string& name, const ScreenRect& rect) {
    if (wanted_) ui_probe_[name] = rect;
  }
  // The item that ImGui drew last; with a tooltip, as tooltip_for_item().
  void note_item(const std::string& name, const std::string& tooltip = "") {
    const ImVec2 low = ImGui::GetItemRectMin();
    const ImVec2 high = ImGui::GetItemRectMax();
    note(name, {{low.x, low.y}, {high.x, high.y}});
    tooltip_for_item(tooltip.c_str());
  }
  // The same for a widget in a condition: passes on whether it was clicked or changed.
  [[nodiscard]] bool noted(bool clicked, const std::string& name, const std::string& tooltip = "") {
    note_item(name, tooltip);
    return clicked;
  }

  // Off at first: note() does nothing then.
  void set_wanted(bool wanted) { wanted_ = wanted; }
  [[nodiscard]] bool wanted() const { return wanted_; }
  [[nodiscard]] const std::map<std::string, ScreenRect>& all() const { return ui_probe_; }
  // At the start of each update.
  void clear() { ui_probe_.clear(); }

 private:
  std::map<std::string, ScreenRect> ui_probe_;
  bool wanted_ = false;
};

}  // namespace sigs::editor
