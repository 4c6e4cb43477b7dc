// SPDX-License-Identifier: MIT
#include "editor/views/timeline/strip.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "editor/widgets/theme.h"

namespace sigs::editor {

namespace {

void darken(ImDrawList& list, ImVec2 low, ImVec2 high, ImU32 shade) {
  if (high.x > low.x) list.AddRectFilled(low, high, shade);
}

}  // namespace

float TimelineStrip::edge_x(double frame) const {
  constexpr double kBeside_px = 100;
  return static_cast<float>(std::clamp(ruler.x_of(frame), left() - kBeside_px, right() + kBeside_px));
}

float TimelineStrip::moment_x(double frame) const {
  return edge_x(frame + 0.5);
}

void draw_playhead_line(ImDrawList& list, const TimelineStrip& strip, int frame, float y_low, float y_high) {
  const float x = std::floor(strip.moment_x(frame));
  const float half = std::max(1.0F, std::round(scaled(1.4))) / 2;
  if (x + half < strip.left() || x - half > strip.right()) return;
  list.AddRectFilled({x - half, y_low}, {x + half, y_high}, color::kAccent);
}

void darken_outside_project(ImDrawList& list, const TimelineStrip& strip, const Document& document, float y_low,
                            float y_high) {
  constexpr ImU32 kShade = IM_COL32(10, 11, 13, 170);
  darken(list, {strip.left(), y_low}, {std::min(strip.right(), strip.edge_x(document.first_frame())), y_high}, kShade);
  darken(list, {std::max(strip.left(), strip.edge_x(document.last_frame() + 1.0)), y_low}, {strip.right(), y_high},
         kShade);
}

void darken_outside_marks(ImDrawList& list, const TimelineStrip& strip, const Document& document, float y_low,
                          float y_high) {
  constexpr ImU32 kShade = IM_COL32(14, 15, 18, 120);
  if (document.in())
    darken(list, {strip.left(), y_low}, {std::min(strip.right(), strip.edge_x(document.range_first())), y_high},
           kShade);
  if (document.out())
    darken(list, {std::max(strip.left(), strip.edge_x(document.range_last() + 1.0)), y_low}, {strip.right(), y_high},
           kShade);
}

void draw_row_line(ImDrawList& list, const TimelineStrip& strip, float y) {
  list.AddRectFilled({strip.names_x, y}, {strip.right(), y + 1}, faded(color::kFaint, 0.06));
}

std::string time_text_of(const ViewContext& context, int frame) {
  if (!context.shown.scene) return {};
  return time_text(time_of_frame_s(context.shown.scene->footage->shape, frame));
}

void go_by_hand(const ViewContext& context, int frame) {
  if (context.playing) context.edits.ask(Play{0});
  if (frame != context.document.playhead()) context.edits.go_to_frame(frame);
}

}  // namespace sigs::editor
