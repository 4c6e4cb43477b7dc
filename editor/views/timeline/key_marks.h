// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "editor/views/timeline/strip.h"

namespace sigs::editor {

// What a row of keys shows.
struct KeyMarks {
  const ViewContext& context;
  const TimelineStrip& strip;
  int intruder = 0;
  const std::vector<double>& frames;  // of the waypoints
  float top_y = 0;
  float height = 0;
  int selected = -1;     // waypoint
  int hot = -1;          // the one below the mouse, or held by it
  bool current = false;  // the intruder that is worked on
};

// Keys as diamonds, hollow where the waypoint's time follows from the others; below them stretches that no such
// aircraft could fly.
void draw_key_marks(ImDrawList& list, const KeyMarks& marks);

// What there is to say of the place below the mouse.
void tooltip_for_keys(const KeyMarks& marks, double mouse_frame);

// What is known of an intruder's flight; null: nothing yet.
[[nodiscard]] const Survey* survey_of(const ViewContext& context, int intruder);

}  // namespace sigs::editor
