// SPDX-License-Identifier: MIT
#pragma once

#include <imgui.h>

#include "editor/views/timeline/lane_values.h"
#include "editor/views/timeline/ruler.h"

namespace sigs::editor {

// One standard deviation to both sides of a lane's curve, where it is known, as a pale band; no finer than the screen.
// first_frame: that of the lane's first value, as a frame of the footage.
void draw_deviation_band(ImDrawList& list, const TimelineStrip& strip, const LaneValues& lane, int first_frame,
                         const LaneBox& box, ImU32 shade);

}  // namespace sigs::editor
