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

enum class Scaling { linear, logarithmic };  // logarithmic: by log(1 + value), so that 0 has a place

// Which values a lane shows from its lower to its upper edge.
struct LaneScale {
  double low = 0;
  double high = 1;
  Scaling scaling = Scaling::linear;

  // 0 at low, 1 at high, clamped to them.
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
