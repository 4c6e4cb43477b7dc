// SPDX-License-Identifier: MIT
#pragma once

#include <imgui.h>

// Icons of the views that show images, for widgets/tool_button.h.
namespace sigs::editor::image_icon {

void box(ImDrawList& draw, ImVec2 center, float side, ImU32 color);
void path(ImDrawList& draw, ImVec2 center, float side, ImU32 color);
void waypoints(ImDrawList& draw, ImVec2 center, float side, ImU32 color);
void horizon(ImDrawList& draw, ImVec2 center, float side, ImU32 color);
void own_body(ImDrawList& draw, ImVec2 center, float side, ImU32 color);
void grid(ImDrawList& draw, ImVec2 center, float side, ImU32 color);
void wipe(ImDrawList& draw, ImVec2 center, float side, ImU32 color);
void fit(ImDrawList& draw, ImVec2 center, float side, ImU32 color);
void target(ImDrawList& draw, ImVec2 center, float side, ImU32 color);
void brush(ImDrawList& draw, ImVec2 center, float side, ImU32 color);
void eraser(ImDrawList& draw, ImVec2 center, float side, ImU32 color);
void undo(ImDrawList& draw, ImVec2 center, float side, ImU32 color);
void redo(ImDrawList& draw, ImVec2 center, float side, ImU32 color);

}  // namespace sigs::editor::image_icon
