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

}  // namespace sigs::editor
