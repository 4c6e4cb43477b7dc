// SPDX-License-Identifier: MIT
#pragma once

#include <imgui.h>

namespace sigs::editor {

// The colours that mean something, one place for all views.
namespace color {
inline constexpr ImU32 kAccent = IM_COL32(88, 166, 255, 255);  // what is selected, the playhead
inline constexpr ImU32 kAccentSoft = IM_COL32(88, 166, 255, 70);
inline constexpr ImU32 kBox = IM_COL32(255, 214, 64, 255);   // the truth's box
inline constexpr ImU32 kPath = IM_COL32(255, 140, 90, 255);  // a trajectory
inline constexpr ImU32 kWaypoint = IM_COL32(255, 255, 255, 255);
inline constexpr ImU32 kHorizon = IM_COL32(120, 220, 200, 200);
inline constexpr ImU32 kOwnBody = IM_COL32(210, 90, 220, 90);
inline constexpr ImU32 kLight = IM_COL32(255, 236, 150, 255);
inline constexpr ImU32 kGood = IM_COL32(96, 200, 120, 255);    // in view
inline constexpr ImU32 kPartly = IM_COL32(240, 190, 70, 255);  // partly hidden
inline constexpr ImU32 kBad = IM_COL32(240, 96, 88, 255);      // a fault, an error
inline constexpr ImU32 kQuiet = IM_COL32(150, 156, 168, 255);  // labels, units
inline constexpr ImU32 kFaint = IM_COL32(255, 255, 255, 40);   // grids, ticks
inline constexpr ImU32 kText = IM_COL32(226, 229, 235, 255);
inline constexpr ImU32 kPanel = IM_COL32(30, 32, 37, 255);
inline constexpr ImU32 kCanvas = IM_COL32(18, 19, 22, 255);  // behind images
inline constexpr ImU32 kAxisX = IM_COL32(236, 92, 92, 255);
inline constexpr ImU32 kAxisY = IM_COL32(110, 200, 96, 255);
inline constexpr ImU32 kAxisZ = IM_COL32(96, 148, 255, 255);
}  // namespace color

// One colour per intruder, in order, repeating after eight.
[[nodiscard]] ImU32 intruder_color(int intruder);

// One colour per tracker whose results are shown, other ones than the truth's, the paths' and the selection's;
// repeating after eight.
[[nodiscard]] ImU32 result_color(int number);

// The same colour with another opacity, 0..1.
[[nodiscard]] ImU32 faded(ImU32 color, double opacity);

// Loads the fonts into ImGui's atlas: Inter from Debian's package, else what is there, else ImGui's own. The size of
// the text is the measure of everything on the screen.
void load_fonts(double text_px);

enum class Font { text, small, bold, title, mono };  // mono: numbers in columns
[[nodiscard]] ImFont* font(Font which);

// ImGui's style, for the fonts that are loaded.
void apply_theme();

// Sizes in pixels where the text is 15 px high, on this screen.
[[nodiscard]] float scaled(double size);

}  // namespace sigs::editor
