// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "editor/views/timeline/lane_values.h"
#include "editor/views/timeline/strip.h"

namespace sigs::editor {

// What is drawn in a lane.
struct LaneMarks {
  const TimelineStrip& strip;
  Lane lane = Lane::visibility_state;
  const Survey* survey = nullptr;  // null: not known yet
  const LaneValues& values;
  float top_y = 0;
  float height = 0;
};

// The curve or the coloured stretches, the closest approach, and in red what no such aircraft could fly.
void draw_lane_marks(ImDrawList& list, const LaneMarks& marks);

void draw_value_dot(ImDrawList& list, const LaneMarks& marks, int frame);
// A hair line at the frame below the mouse, with its value.
void draw_hover(ImDrawList& list, const LaneMarks& marks, int frame);
// Once the mouse has rested: over visibility_states all that is known of a frame, over curves why it is flagged.
void tooltip_for_lanes(const ViewContext& context, const LaneMarks& marks, int frame);

// The lane's value in words: "933 m", "in view"; "-" where it is not known.
[[nodiscard]] std::string lane_text_at(const LaneMarks& marks, int frame);

}  // namespace sigs::editor
