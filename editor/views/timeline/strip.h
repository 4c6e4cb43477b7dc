// SPDX-License-Identifier: MIT
#pragma once

#include "editor/geometry/time_ruler.h"
#include "editor/views/context.h"

struct ImDrawList;

namespace sigs::editor {

// Where the timeline's rows lie on the screen: names at the left, then the strip with the ruler's frames. What stands
// for a moment, as a waypoint or the playhead, lies in the middle of its frame's cell.
struct TimelineStrip {
  TimeRuler ruler;
  float names_x = 0;
  float names_width = 0;

  [[nodiscard]] float left() const { return static_cast<float>(ruler.left_x); }
  [[nodiscard]] float right() const { return static_cast<float>(ruler.left_x + ruler.width); }
  // Kept near the strip, whatever the frame, so that it can be drawn.
  [[nodiscard]] float edge_x(double frame) const;    // where the frame's cell begins
  [[nodiscard]] float moment_x(double frame) const;  // its middle
  [[nodiscard]] double moment_at(double x) const { return ruler.frame_at(x) - 0.5; }
  [[nodiscard]] bool shows(double frame) const {
    return frame >= ruler.first - 1 && frame <= ruler.first + ruler.count;
  }
};

// From y_low to y_high across the rows.
void draw_playhead_line(ImDrawList& list, const TimelineStrip& strip, int frame, float y_low, float y_high);
// The ground outside the project's frames, before anything is drawn on it; and a veil over what in and out leave out.
void darken_outside_project(ImDrawList& list, const TimelineStrip& strip, const Document& document, float y_low,
                            float y_high);
void darken_outside_marks(ImDrawList& list, const TimelineStrip& strip, const Document& document, float y_low,
                          float y_high);
void draw_row_line(ImDrawList& list, const TimelineStrip& strip, float y);

// Time of a frame by the footage that is open; none before one is.
[[nodiscard]] std::string time_text_of(const ViewContext& context, int frame);

// Playing stops and the playhead goes there.
void go_by_hand(const ViewContext& context, int frame);

}  // namespace sigs::editor
