// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

#include "editor/views/context.h"
#include "editor/views/timeline/keys.h"
#include "editor/views/timeline/lanes.h"
#include "editor/views/timeline/ruler.h"
#include "editor/views/timeline/transport_bar.h"

namespace sigs::editor {

// The timeline: transport and ruler, waypoints as keys, lanes of distance, size and visibility, in and out. The wheel
// over the strip zooms, with Shift it pans; so does the middle button.
class TimelineView {
 public:
  // Once per update, into what is left of the current ImGui window.
  void draw(const ViewContext& context);

 private:
  // Shows all frames when another project or footage is open.
  void fit_to(const ViewContext& context);
  // Brings the playhead into sight when it has moved; while it plays, page by page.
  void follow_playhead(const ViewContext& context);
  // The strip at the cursor.
  [[nodiscard]] TimelineStrip strip_here() const;
  // Buttons that choose lanes and fit the ruler.
  void draw_left_of_ruler(const ViewContext& context, const TimelineStrip& strip);
  void draw_rows(const ViewContext& context, const TimelineStrip& strip);
  void handle_wheel(const TimelineStrip& strip, float low_y, float high_y);

  TransportBar transport_;
  RulerRow ruler_row_;
  KeyRows keys_;
  LaneRows lanes_;

  // Which frames are shown; left_x and width are those of strip_here().
  TimeRuler ruler_;
  // What the ruler was made for: the number of frames of the footage, and the project.
  int frame_count_ = -1;
  std::filesystem::path file_;
  // Of the update before.
  int playhead_ = -1;
  bool panning_ = false;
};

}  // namespace sigs::editor
