// SPDX-License-Identifier: MIT
#pragma once

#include <imgui.h>

#include <string>

#include "editor/views/context.h"
#include "editor/views/timeline/lane_values.h"
#include "editor/views/timeline/ruler.h"

namespace sigs::editor {

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
