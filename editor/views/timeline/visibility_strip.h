// SPDX-License-Identifier: MIT
#pragma once

#include <imgui.h>

#include "editor/preview/preview_output.h"
#include "editor/views/timeline/ruler.h"

namespace sigs::editor {

// The colour of a state in the lane of visibility.
[[nodiscard]] ImU32 color_of(VisibilityState visibility_state);

// What the lane of visibility shows: stretches of frames in the colours of their states, with a margin above and below.
// top_y and height are the lane's, in screen pixels. Where several frames share a pixel, the first of them shows.
void draw_visibility_strip(ImDrawList& list, const TimelineStrip& strip, const Survey& survey, float top_y,
                           float height);

// For a tooltip: what the colours mean, a line each.
void list_visibility_colors();

}  // namespace sigs::editor
