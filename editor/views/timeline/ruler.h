// SPDX-License-Identifier: MIT
#pragma once

#include "editor/geometry/rulers.h"
#include "editor/views/context.h"

namespace sigs::editor {

// Where the timeline's rows lie on the screen in this update: names at the left, then the strip with the ruler's
// frames. What stands for a moment, as a waypoint or the playhead, lies in the middle of its frame's cell. All x are
// screen coordinates.
struct TimelineStrip {
  TimeRuler ruler;
  float names_x = 0;
  float names_width = 0;

  [[nodiscard]] float left() const { return static_cast<float>(ruler.left_x); }
  [[nodiscard]] float right() const { return static_cast<float>(ruler.left_x + ruler.width); }
  // Kept near the strip, whatever the frame, so that it can be drawn.
  [[nodiscard]] float edge_x(double frame) const;    // where the frame's cell begins
  [[nodiscard]] float moment_x(double frame) const;  // its middle
  // The moment, in frames, at a place of the strip: the inverse of moment_x() within the strip.
  [[nodiscard]] double moment_at(double x) const { return ruler.frame_at(x) - 0.5; }
  // Whether what is drawn at the frame may reach the strip.
  [[nodiscard]] bool shows(double frame) const {
    return frame >= ruler.first - 1 && frame <= ruler.first + ruler.count;
  }
};

// From y_low to y_high across the rows.
void draw_playhead_line(ImDrawList& list, const TimelineStrip& strip, int frame, float y_low, float y_high);
// Darken the background outside the project's frames (before anything is drawn on it), and the area outside the in and
// out marks (after that).
void darken_outside_project(ImDrawList& list, const TimelineStrip& strip, const Document& document, float y_low,
                            float y_high);
void darken_outside_marks(ImDrawList& list, const TimelineStrip& strip, const Document& document, float y_low,
                          float y_high);
void draw_row_line(ImDrawList& list, const TimelineStrip& strip, float y);

// Time of a frame by the footage that is open; none before one is.
[[nodiscard]] std::string time_text_of(const ViewContext& context, int frame);

// The ruler in frames and times: scrubbing, in and out, and which frames are ready to be shown.
class RulerRow {
 public:
  // In screen pixels.
  [[nodiscard]] static float height();

  // At the cursor's height.
  void draw(const ViewContext& context, const TimelineStrip& strip);

  // The playhead follows the mouse on the item that was drawn last (a row that has no other use for it); with Shift ten
  // times finer.
  void scrub_on_item(const ViewContext& context, const TimelineStrip& strip);

 private:
  // What the mouse holds since its press: the playhead, or the mark of in or out.
  enum class Held { none, playhead, in, out };

  void scrub_while_held(const ViewContext& context, const TimelineStrip& strip);
  void handle_mouse(const ViewContext& context, const TimelineStrip& strip, float bar_top_y);
  // Moves the playhead to the mouse. pressed: in this update.
  void scrub(const ViewContext& context, const TimelineStrip& strip, bool pressed);
  void draw_menu(const ViewContext& context, const TimelineStrip& strip);

  Held held_ = Held::none;
  double scrub_x_ = 0;  // where the mouse would be if it did not go finer
  int menu_frame_ = 0;  // the frame on which the right button was pressed
};

}  // namespace sigs::editor
