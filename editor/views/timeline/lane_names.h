// SPDX-License-Identifier: MIT
#pragma once

#include <imgui.h>

#include <string>

#include "editor/views/timeline/ruler.h"

namespace sigs::editor {

// Left of a lane: title and value in one line; below, where there is room, what the values come to.
//   low     upper left corner of the lane's row
//   extent  may be empty
void draw_lane_names(const TimelineStrip& strip, const char* title, ImVec2 low, float height, const std::string& value,
                     const std::string& extent);

}  // namespace sigs::editor
