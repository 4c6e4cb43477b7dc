// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "editor/preview/preview_output.h"
#include "editor/views/context.h"
#include "editor/views/timeline/lane_values.h"
#include "editor/views/timeline/ruler.h"

namespace sigs::editor {

// The lane "Well clear": when it is lost, for each volume, with entries, exits and the closest approach as marks that
// lead to their frame.

struct EncounterMark {
  enum class Kind { entry, exit, closest };
  Kind kind = Kind::closest;
  double frame = 0;  // where it is drawn; fractional
  int go_to = 0;     // the frame that shows it: the first or last one of a loss, the nearest to a closest approach
  std::size_t volume = 0;  // index in EncounterSurvey::volumes; not for the closest approach
  std::string text;        // "well clear lost (small-uas) at 3.214 s"
};
// By frame. A loss that the clip begins or ends in has no entry or no exit. None at all where the flights cannot be
// compared.
[[nodiscard]] std::vector<EncounterMark> encounter_marks(const EncounterSurvey& survey);

// The mark within reach of a place of the strip (screen x): the nearest one. Null: there is none.
[[nodiscard]] const EncounterMark* mark_at(const std::vector<EncounterMark>& marks, const TimelineStrip& strip,
                                           double x);

// One bar for each volume, from top to bottom in their order.
void draw_clear_strip(ImDrawList& list, const TimelineStrip& strip, const EncounterSurvey& survey, float top_y,
                      float height);

// "clear", or "lost" where it is lost for any of the volumes.
[[nodiscard]] const char* clear_text(const EncounterSurvey& survey, int frame);
// "small-uas: lost", a line for each volume.
[[nodiscard]] std::string clear_lines(const EncounterSurvey& survey, int frame);

// What the colours and marks mean, in a tooltip.
void list_clear_colors();

// Red where well clear is lost for the first volume, over a lane's height.
void draw_loss_ground(ImDrawList& list, const TimelineStrip& strip, const EncounterSurvey& survey, float top_y,
                      float height);

// The colour of a state in the lane of visibility.
[[nodiscard]] ImU32 color_of(VisibilityState visibility_state);

// What the lane of visibility shows: stretches of frames in the colours of their states, with a margin above and below.
// top_y and height are the lane's, in screen pixels. Where several frames share a pixel, the first of them shows.
void draw_visibility_strip(ImDrawList& list, const TimelineStrip& strip, const Survey& survey, float top_y,
                           float height);

// For a tooltip: what the colours mean, a line each.
void list_visibility_colors();

// One standard deviation to both sides of a lane's curve, where it is known, as a pale band; no finer than the screen.
// first_frame: that of the lane's first value, as a frame of the footage.
void draw_deviation_band(ImDrawList& list, const TimelineStrip& strip, const LaneValues& lane, int first_frame,
                         const LaneBox& box, ImU32 shade);

// From one moment to another, both in the middle of frames, cut to the strip and at least 2 px wide.
void draw_stretch(ImDrawList& list, const TimelineStrip& strip, double first_frame, double last_frame, float top_y,
                  float bottom_y, ImU32 shade);

// A line of one pixel over the strip's width.
void draw_level(ImDrawList& list, const TimelineStrip& strip, float y, ImU32 shade);

// A curve as curve_of() has it; and a value of it in one frame.
void draw_polylines(ImDrawList& list, const std::vector<Polyline>& lines, ImU32 shade);
void draw_dot(ImDrawList& list, ImVec2 center, ImU32 shade);

// What is wrong with the flight in a frame or beside it, a line each. fault none: all that is.
[[nodiscard]] std::string flags_text(const Survey& survey, double frame, std::optional<FlightFault> fault = {});

// What is drawn in a lane, and where. y and heights in screen pixels.
struct LaneMarks {
  const TimelineStrip& strip;
  const LaneStyle& style;
  const LaneValues& values;
  const Survey* survey = nullptr;  // null: not known yet
  float top_y = 0;
  float height = 0;
};

// The strip or the curve; with a curve the closest approach, in red what no such aircraft could fly, and losses of well
// clear where the lane is of the encounter.
void draw_lane_marks(ImDrawList& list, const LaneMarks& marks);

// On the curve at a frame; nothing where it has no value there.
void draw_value_dot(ImDrawList& list, const LaneMarks& marks, int frame);

// The lane's value in words: "933 m", "in view"; "-" where it is not known.
[[nodiscard]] std::string lane_text_at(const LaneMarks& marks, int frame);

// A hair line at the frame below the mouse, with its value.
void draw_hover(ImDrawList& list, const LaneMarks& marks, int frame);

// While the log is shifted: by what, beside the mouse.
void draw_offset(ImDrawList& list, const ViewContext& context, const LaneMarks& marks);

// Once the mouse has rested: over a strip all that is known of a frame and what the colours mean, over a curve why it
// is flagged.
void tooltip_for_lanes(const ViewContext& context, const LaneMarks& marks, int frame);

}  // namespace sigs::editor
