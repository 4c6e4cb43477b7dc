// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

#include "editor/views/context.h"
#include "editor/views/timeline/keys.h"
#include "editor/views/timeline/lanes.h"
#include "editor/views/timeline/ruler.h"
#include "editor/views/timeline/transport_bar.h"

namespace sigs::editor {

// Ruler, transport, waypoints as keys, lanes of distance, size and visibility, in and out.
class TimelineView {
 public:
  // Into what is left of the current ImGui window.
  void draw(const ViewContext& context);

 private:
  void fit_to(const ViewContext& context);
  void follow_playhead(const ViewContext& context);
  [[nodiscard]] TimelineStrip strip_here() const;
  void draw_left_of_ruler(const ViewContext& context, const TimelineStrip& strip);
  void draw_rows(const ViewContext& context, const TimelineStrip& strip);
  void handle_wheel(const TimelineStrip& strip, float low_y, float high_y);

  TransportBar transport_;
  RulerRow ruler_row_;
  KeyRows keys_;
  LaneRows lanes_;

  TimeRuler ruler_;
  int frame_count_ = -1;        // that the ruler was made for
  std::filesystem::path file_;  // the project that it was made for
  int playhead_ = -1;           // of the update before
  bool panning_ = false;
};

}  // namespace sigs::editor
