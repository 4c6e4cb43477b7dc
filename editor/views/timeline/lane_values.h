// SPDX-License-Identifier: MIT
#pragma once

#include <imgui.h>

#include <optional>
#include <string>
#include <vector>

#include "editor/preview/preview_output.h"
#include "editor/views/timeline/lane_curve.h"

namespace sigs::editor {

// What the timeline shows of the current intruder from frame to frame.
enum class Lane { visibility_state, distance, size, speed, load, climb };
inline constexpr int kLanes = 6;

// Words, colours and limits of a lane.
struct LaneStyle {
  const char* title;
  const char* help;
  ImU32 color;
  double min_span;  // of the scale: what varies less looks level
  Scaling scaling;
  std::optional<double> reference;  // a line at a value that means something
};
[[nodiscard]] const LaneStyle& style_of(Lane lane);

// Values of all frames of a survey, and how they are shown. None for visibility_states, which are no numbers.
struct LaneValues {
  std::vector<double> values;
  LaneScale scale;
  double minimum = 0;
  double maximum = 0;
};
// Not for visibility_states; i counts the survey's frames.
[[nodiscard]] double value_in(const Survey& survey, Lane lane, std::size_t i);
[[nodiscard]] LaneValues values_of(const Survey& survey, Lane lane);

// "933 m", "13.4 px", "+2.1 m/s".
[[nodiscard]] std::string value_text(Lane lane, double value);

[[nodiscard]] bool belongs_to(FlightFault fault, Lane lane);

[[nodiscard]] const char* name_of(VisibilityState visibility_state);
[[nodiscard]] ImU32 color_of(VisibilityState visibility_state);

}  // namespace sigs::editor
