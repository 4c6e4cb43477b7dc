// SPDX-License-Identifier: MIT
#include "editor/views/timeline/timeline_view.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "editor/views/waypoint_actions.h"

namespace sigs::editor {

namespace {

constexpr double kNames_px = 156;
constexpr double kWheelZoom = 1.25;  // a notch
constexpr double kWheelPan = 0.12;   // of the strip
constexpr double kEndMargin = 0.02;  // of the frames
constexpr double kPageMargin = 0.1;  // where the playhead comes in when playing turns the page

// All of the footage, also while its length is not known, with some room for keys at its ends.
TimeRuler whole(const Document& document) {
  const double count = std::max(4, document.frame_count() > 0 ? document.frame_count() : 250);
  return {.first = -kEndMargin * count, .count = (1 + 2 * kEndMargin) * count};
}

bool in_sight(const TimeRuler& ruler, int frame) {
  return frame >= ruler.first && frame + 1 <= ruler.first + ruler.count;
}

void draw_no_intruder(const ViewContext& context, const TimelineStrip& strip) {
  ImGui::SetCursorScreenPos({strip.names_x, ImGui::GetCursorScreenPos().y + scaled(6)});
  if (icon_button("add intruder", Icon::plus, "add an intruder ahead of the camera")) add_intruder(context);
  ImGui::SameLine();
  ImGui::AlignTextToFramePadding();
  ImGui::TextDisabled(
      "%s", elided("No intruder yet. Add one: its waypoints show here.", ImGui::GetContentRegionAvail().x).c_str());
}

}  // namespace

void TimelineView::fit_to(const ViewContext& context) {
  const Document& document = context.document;
  if (document.frame_count() == frame_count_ && context.project().file == file_) return;
  ruler_ = whole(document);
  frame_count_ = document.frame_count();
  file_ = context.project().file;
}

void TimelineView::follow_playhead(const ViewContext& context) {
  const int playhead = context.document.playhead();
  if (playhead == std::exchange(playhead_, playhead) || panning_ || in_sight(ruler_, playhead)) return;
  if (context.playing) {
    const double into = context.speed < 0 ? 1 - kPageMargin : kPageMargin;
    ruler_ = panned(ruler_, playhead - into * ruler_.count - ruler_.first, frame_count_);
  }
  ruler_ = with_frame_in_sight(ruler_, playhead, frame_count_);
}

TimelineStrip TimelineView::strip_here() const {
  const ImVec2 low = ImGui::GetCursorScreenPos();
  const float room = ImGui::GetContentRegionAvail().x;
  TimelineStrip strip{.ruler = ruler_, .names_x = low.x};
  strip.names_width = std::floor(std::min(scaled(kNames_px), room * 0.3F));
  strip.ruler.left_x = low.x + strip.names_width;
  strip.ruler.width = std::max(1.0F, room - strip.names_width - ImGui::GetStyle().ScrollbarSize);
  return strip;
}

void TimelineView::draw_left_of_ruler(const ViewContext& context, const TimelineStrip& strip) {
  const ImVec2 low{strip.names_x, ImGui::GetCursorScreenPos().y};
  const float y = low.y + std::floor((RulerRow::height() - ImGui::GetFrameHeight()) / 2);
  const float side = icon_button_width();
  ImGui::SetCursorScreenPos({low.x, y});
  lanes_.draw_chooser(context);
  ImGui::SetCursorScreenPos({low.x + side + scaled(1), y});
  if (icon_button("fit", Icon::fit, "show all frames")) ruler_ = whole(context.document);
  ImGui::SetCursorScreenPos({low.x + 2 * (side + scaled(1)), y});
  if (icon_button("fit range", Icon::search, "show the range from in to out")) {
    const Document& document = context.document;
    ruler_.first = document.range_first();
    ruler_.count = std::max(4, document.range_last() - document.range_first() + 1);
    ruler_ = panned(ruler_, 0, frame_count_);
  }
  ImGui::SetCursorScreenPos(low);
}

void TimelineView::handle_wheel(const TimelineStrip& strip, float low_y, float high_y) {
  const ImGuiIO& io = ImGui::GetIO();
  const bool over =
      ImGui::IsWindowHovered(ImGuiHoveredFlags_ChildWindows | ImGuiHoveredFlags_AllowWhenBlockedByActiveItem) &&
      io.MousePos.x >= strip.left() && io.MousePos.x < strip.right() && io.MousePos.y >= low_y &&
      io.MousePos.y < high_y;
  if (over && ImGui::IsMouseClicked(ImGuiMouseButton_Middle)) panning_ = true;
  if (!ImGui::IsMouseDown(ImGuiMouseButton_Middle)) panning_ = false;
  if (panning_) {
    ImGui::SetMouseCursor(ImGuiMouseCursor_Hand);
    ruler_ = panned(ruler_, -io.MouseDelta.x / strip.ruler.width * ruler_.count, frame_count_);
  }
  if (!over) return;
  const double across = io.KeyShift ? io.MouseWheel : io.MouseWheelH;
  if (across != 0) ruler_ = panned(ruler_, -across * kWheelPan * ruler_.count, frame_count_);
  if (!io.KeyShift && io.MouseWheel != 0) {
    TimeRuler placed = strip.ruler;
    placed.first = ruler_.first;
    ruler_ = zoomed(placed, std::pow(kWheelZoom, io.MouseWheel), io.MousePos.x, frame_count_);
  }
}

void TimelineView::draw_rows(const ViewContext& context, const TimelineStrip& strip) {
  // The wheel zooms over the strip and scrolls over the names.
  const bool over_names = ImGui::GetIO().MousePos.x < strip.left();
  const ImVec2 room = ImGui::GetContentRegionAvail();
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {scaled(8), 0});
  ImGui::BeginChild("rows", {0, std::max(1.0F, room.y)}, false,
                    over_names ? ImGuiWindowFlags_None : ImGuiWindowFlags_NoScrollWithMouse);
  ImGui::PopStyleVar();
  const ImVec2 low = ImGui::GetWindowPos();
  const ImVec2 high{low.x + ImGui::GetWindowWidth(), low.y + ImGui::GetWindowHeight()};
  const float start_y = ImGui::GetCursorPosY();
  ImDrawList& list = *ImGui::GetWindowDrawList();
  if (context.project().intruders.empty()) {
    draw_no_intruder(context, strip);
  } else {
    darken_outside_project(list, strip, context.document, low.y, high.y);
    keys_.draw(context, strip);
    lanes_.draw(context, strip, ImGui::GetWindowHeight() - (ImGui::GetCursorPosY() - start_y), ruler_row_);
    darken_outside_marks(list, strip, context.document, low.y, high.y);
    draw_playhead_line(list, strip, context.document.playhead(), low.y, high.y);
  }
  ImGui::Dummy({1, 0});
  ImGui::EndChild();
}

void TimelineView::draw(const ViewContext& context) {
  fit_to(context);
  follow_playhead(context);
  transport_.draw(context);
  const TimelineStrip strip = strip_here();
  const float low_y = ImGui::GetCursorScreenPos().y;
  const float high_y = low_y + ImGui::GetContentRegionAvail().y;
  draw_left_of_ruler(context, strip);
  ruler_row_.draw(context, strip);
  ImGui::SetCursorScreenPos({strip.names_x, low_y + RulerRow::height()});
  draw_rows(context, strip);
  handle_wheel(strip, low_y, high_y);
}

}  // namespace sigs::editor
