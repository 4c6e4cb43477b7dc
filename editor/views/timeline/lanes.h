// SPDX-License-Identifier: MIT
#pragma once

#include <imgui.h>

#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "editor/geometry/rulers.h"
#include "editor/preview/preview_output.h"
#include "editor/views/context.h"
#include "editor/views/timeline/ruler.h"

namespace sigs::editor {

// logarithmic: by log(1 + value), so that 0 has a place; negative values count as 0.
enum class Scaling { linear, logarithmic };

// Which values a lane shows from its lower to its upper edge.
struct LaneScale {
  double low = 0;
  double high = 1;
  Scaling scaling = Scaling::linear;

  // Height of a value: 0 at low, 1 at high, clamped to them; 0.5 where low and high are equal.
  [[nodiscard]] double share_of(double value) const;
};

// For all finite values: from 0 where they come near it, else a little more than they take; never less across than
// min_span.
[[nodiscard]] LaneScale scale_for(std::span<const double> values, double min_span, Scaling scaling = Scaling::linear);

// Where a lane's curve is drawn.
struct LaneBox {
  double top_y = 0;
  double height = 1;
};

// The values of successive frames as lines on the screen, no more points than it takes to be within a third of a pixel;
// where several frames share a pixel both extremes show. Values that are not finite leave gaps. Frame n lies in the
// middle of its cell.
using Polyline = std::vector<glm::vec2>;
[[nodiscard]] std::vector<Polyline> curve_of(std::span<const double> values, int first_frame, const TimeRuler& ruler,
                                             const LaneScale& scale, const LaneBox& box);

// What the timeline shows of the current intruder from frame to frame, and of the camera. visibility has a
// VisibilityState a frame; distance is in metres, size in pixels, speed and climb in m/s, load in g; roll, pitch and
// yaw, those of the camera, in degrees, yaw without jumps at 180.
// clear is when well clear is lost, beside the horizontal range in metres, tau modified tau in seconds.
enum class Lane { visibility, clear, distance, beside, tau, size, speed, load, climb, roll, pitch, yaw };

// Which part of a survey has a lane's values.
enum class LaneSource { estimates, encounter, flight, camera };

// Words, colours and values of a lane. The texts are literals. A strip shows coloured stretches of frames, in a row of
// a line's height; all others are curves: numbers on a scale, which share the room that strips leave.
struct LaneStyle {
  Lane lane;
  LaneSource source;
  bool shown_by_default = true;  // false: it is hidden until a person ticks it in the list of lanes
  const char* title;
  const char* help;
  // Of a curve; strips have a colour for each state. NaN: nothing of it is in the image, so it has no size.
  ImU32 color = 0;
  double (*value)(const Survey& survey, std::size_t i) = nullptr;  // i: an index of the survey's frames
  double Attitude::*angle_rad = nullptr;                           // in place of a value, of the camera
  std::string (*text)(double value) = nullptr;                     // of finite values: "933 m", "+2.1 m/s"
  double min_span = 1;  // of the scale, in the lane's unit: what varies less looks level
  Scaling scaling = Scaling::linear;
  std::optional<double> reference = std::nullopt;   // a line at a value that means something: level flight, no climb
  std::optional<FlightFault> fault = std::nullopt;  // that is marked in this lane

  [[nodiscard]] constexpr bool is_strip() const { return value == nullptr && angle_rad == nullptr; }
  [[nodiscard]] constexpr bool is_of_camera() const { return source == LaneSource::camera; }  // not of the intruder
  [[nodiscard]] constexpr bool is_of_encounter() const { return source == LaneSource::encounter; }
};
// One for each lane, in the order in which the timeline and the list of lanes show them.
[[nodiscard]] std::span<const LaneStyle> lane_styles();
[[nodiscard]] const LaneStyle& style_of(Lane lane);

// Values of all frames of a survey, and how they are shown. Without values for strips, whose states are no numbers.
struct LaneValues {
  std::vector<double> values;
  // Standard deviations, one for each value, NaN where it is not known; empty: none is.
  std::vector<double> deviations;
  LaneScale scale;
  // Of the finite values; 0 where there is none.
  double minimum = 0;
  double maximum = 0;
};
[[nodiscard]] LaneValues values_of(const Survey& survey, Lane lane);

// Of a curve: "933 m", "13.4 px", "+2.1 m/s"; "-" for what is not finite.
[[nodiscard]] std::string value_text(Lane lane, double value);

// What a lane of either kind says of a frame: "933 m", "in view", "-12.3\u00b0 \u00b10.2\u00b0" with a standard
// deviation that is known; yaw within 180 degrees. i is an index of the survey's frames; "-" where the
// survey has no such frame.
[[nodiscard]] std::string text_in(const Survey& survey, Lane lane, std::size_t i);

// "in view", "partly hidden", "hidden", "out of view".
[[nodiscard]] const char* name_of(VisibilityState visibility_state);

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
