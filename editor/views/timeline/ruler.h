// SPDX-License-Identifier: MIT
#pragma once

#include "editor/views/timeline/strip.h"

namespace sigs::editor {

// The ruler in frames and times: scrubbing, in and out, and which frames are ready to be shown.
class RulerRow {
 public:
  [[nodiscard]] static float height();

  // At the cursor's height.
  void draw(const ViewContext& context, const TimelineStrip& strip);

  // While the mouse holds the playhead.
  [[nodiscard]] bool scrubbing() const { return held_ == Held::playhead; }

  // The playhead follows the mouse on the item that was drawn last (a row that has no other use for it); with Shift ten
  // times finer.
  void scrub_on_item(const ViewContext& context, const TimelineStrip& strip);

 private:
  enum class Held { none, playhead, in, out };

  void scrub_while_held(const ViewContext& context, const TimelineStrip& strip);
  void handle_mouse(const ViewContext& context, const TimelineStrip& strip, float bar_top_y);
  void scrub(const ViewContext& context, const TimelineStrip& strip, bool pressed);
  void draw_menu(const ViewContext& context, const TimelineStrip& strip);

  Held held_ = Held::none;
  double scrub_x_ = 0;  // where the mouse would be if it did not go finer
  int menu_frame_ = 0;
};

}  // namespace sigs::editor
