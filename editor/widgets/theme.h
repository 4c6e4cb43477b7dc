// SPDX-License-Identifier: MIT
#pragma once

#include <imgui.h>

#include <array>
#include <glm/glm.hpp>

namespace sigs::editor {

// Points on the screen, as ImGui has them (float) and as we do (double), in the same coordinates.
[[nodiscard]] inline ImVec2 im(const glm::dvec2& p) {
  return {static_cast<float>(p.x), static_cast<float>(p.y)};
}
[[nodiscard]] inline glm::dvec2 dv(const ImVec2& p) {
  return {p.x, p.y};
}

// The colours that mean something, one place for all views.
namespace color {
// What is selected, the playhead.
inline constexpr ImU32 kAccent = IM_COL32(88, 166, 255, 255);
inline constexpr ImU32 kAccentSoft = IM_COL32(88, 166, 255, 70);
// Over the footage: the truth's box, a trajectory's waypoints, the simulated horizon, the own body, the light.
inline constexpr ImU32 kBox = IM_COL32(255, 214, 64, 255);
inline constexpr ImU32 kWaypoint = IM_COL32(255, 255, 255, 255);
inline constexpr ImU32 kHorizon = IM_COL32(120, 220, 200, 200);
inline constexpr ImU32 kOwnBody = IM_COL32(210, 90, 220, 90);
inline constexpr ImU32 kLight = IM_COL32(255, 236, 150, 255);
// Aircraft that the footage itself shows.
inline constexpr ImU32 kRealAircraft = IM_COL32(255, 84, 170, 255);
// How well something is: an intruder in view, partly occluded, a fault or an error.
inline constexpr ImU32 kGood = IM_COL32(96, 200, 120, 255);
inline constexpr ImU32 kPartly = IM_COL32(240, 190, 70, 255);
inline constexpr ImU32 kBad = IM_COL32(240, 96, 88, 255);
inline constexpr ImU32 kQuiet = IM_COL32(150, 156, 168, 255);  // labels, units
inline constexpr ImU32 kFaint = IM_COL32(255, 255, 255, 40);   // grids, ticks
inline constexpr ImU32 kText = IM_COL32(226, 229, 235, 255);
inline constexpr ImU32 kPanel = IM_COL32(30, 32, 37, 255);
inline constexpr ImU32 kCanvas = IM_COL32(18, 19, 22, 255);  // behind images
// The axes of the world: X forward, Y right, Z down.
inline constexpr ImU32 kAxisX = IM_COL32(236, 92, 92, 255);
inline constexpr ImU32 kAxisY = IM_COL32(110, 200, 96, 255);
inline constexpr ImU32 kAxisZ = IM_COL32(96, 148, 255, 255);
inline constexpr std::array<ImU32, 3> kAxes{kAxisX, kAxisY, kAxisZ};
}  // namespace color

// One colour per intruder, in order, repeating after eight.
[[nodiscard]] ImU32 intruder_color(int intruder);

// One colour per tracker whose results are shown, other ones than the truth's, the paths' and the selection's;
// repeating after eight.
[[nodiscard]] ImU32 result_color(int number);

// The same colour with another opacity, 0..1.
[[nodiscard]] ImU32 faded(ImU32 color, double opacity);

// Loads the fonts into ImGui's atlas, outside of an update: Inter from Debian's package, else Roboto or DejaVu where
// they are, else ImGui's own. text_px: height of the text in screen pixels, the measure of everything on the screen.
void load_fonts(double text_px);

// Sizes relative to the text: small .87, title 1.7, mono .9. mono is for numbers in columns.
enum class Font { text, small, bold, title, mono };
// One of the fonts that load_fonts() loaded; ImGui owns it, until the next load_fonts().
[[nodiscard]] ImFont* font(Font which);

// Sets ImGui's style, for the fonts that are loaded: after load_fonts().
void apply_theme();

// A size given in pixels where the text is 15 px high, in pixels of this screen. All sizes of the editor go through
// this.
[[nodiscard]] float scaled(double size);

}  // namespace sigs::editor
