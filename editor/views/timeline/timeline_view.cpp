// SPDX-License-Identifier: MIT
#include "editor/views/timeline/timeline_view.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <functional>
#include <limits>
#include <numeric>
#include <string>
#include <utility>

#include "base/text.h"
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

namespace {

constexpr double kMaxFrames = 1e9;

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

// Without sign or exponent, all of the text.
std::optional<double> number(std::string_view text) {
  if (text.find_first_not_of("0123456789.") != std::string_view::npos) return std::nullopt;
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error == std::errc::result_out_of_range) return std::numeric_limits<double>::infinity();
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

// "h:mm:ss.ss" or "m:ss.ss".
std::optional<double> time_in(std::string_view text) {
  double time_s = 0;
  while (true) {
    const auto colon = text.find(':');
    const std::optional<double> part = number(text.substr(0, colon));
    if (!part) return std::nullopt;
    time_s = time_s * 60 + *part;
    if (colon == std::string_view::npos) return time_s;
    text.remove_prefix(colon + 1);
  }
}

double nearest_in_time(double time_s, std::span<const double> times_s) {
  const auto after = std::ranges::lower_bound(times_s, time_s);
  const auto number = static_cast<double>(after - times_s.begin());
  if (after == times_s.begin()) return 0;
  return after == times_s.end() || time_s - *(after - 1) <= *after - time_s ? number - 1 : number;
}

// A part of the bar. Those with a low rank are left out last.
struct BarItem {
  int rank = 0;
  float gap = 0;  // before it
  float width = 0;
  std::function<void()> draw;
  const char* name = "";  // among the places
};

using Bar = std::vector<BarItem>;

float text_width(const std::string& text) {
  return ImGui::CalcTextSize(text.c_str()).x;
}

void draw_those_that_fit(const ViewContext& context, const Bar& bar) {
  float room = ImGui::GetContentRegionAvail().x;
  std::vector<std::size_t> order(bar.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, [&](auto a, auto b) { return bar[a].rank < bar[b].rank; });
  int full_from = 1000;  // of one rank all or none
  for (const std::size_t i : order) {
    room -= bar[i].gap + bar[i].width;
    if (room < 0) full_from = std::min(full_from, bar[i].rank);
  }
  float x = ImGui::GetCursorPosX();
  const float y = ImGui::GetCursorPosY();
  for (const BarItem& item : bar) {
    if (item.rank >= full_from) continue;
    x += item.gap;
    ImGui::SetCursorPos({x, y});
    item.draw();
    if (*item.name != '\0') context.ui_probe.note_item(std::string("timeline/") + item.name);
    x += item.width;
  }
  ImGui::SetCursorPos({ImGui::GetCursorStartPos().x, y + ImGui::GetFrameHeightWithSpacing()});
}

void text_in_line(const std::string& text, ImU32 shade, const char* tooltip) {
  ImGui::AlignTextToFramePadding();
  draw_text(text, shade);
  tooltip_for_item(tooltip);
}

BarItem button(int rank, float gap, const char* id, Icon icon, const char* tooltip, bool on,
               std::function<void()> action) {
  return {rank, gap, icon_button_width(),
          [=, action = std::move(action)] {
            if (icon_button(id, icon, tooltip, on)) action();
          },
          id};
}

void step(const ViewContext& context, int by) {
  go_by_hand(context, context.document.playhead() + by);
}

void add_transport(Bar& bar, const ViewContext& context) {
  const float gap = scaled(1);
  const Document& document = context.document;
  bar.push_back(button(4, 0, "start", Icon::to_start, "to the first frame of the range (Home)", false,
                       [&] { go_by_hand(context, document.range_first()); }));
  bar.push_back(button(2, gap, "back", Icon::back, "one frame back (Left)", false, [&] { step(context, -1); }));
  bar.push_back(button(0, gap, "play", context.playing ? Icon::pause : Icon::play, "play, stop (Space)",
                       context.playing, [&] { context.edits.ask(TogglePlay{}); }));
  bar.push_back(button(2, gap, "forward", Icon::forward, "one frame on (Right)", false, [&] { step(context, 1); }));
  bar.push_back(button(4, gap, "end", Icon::to_end, "to the last frame of the range (End)", false,
                       [&] { go_by_hand(context, document.range_last()); }));
  bar.push_back(button(5, gap, "loop", Icon::loop, "start again at the end of the range", context.settings.loop,
                       [&] { context.edits.ask(SetLoop{!context.settings.loop}); }));
}

void add_speed(Bar& bar, const ViewContext& context) {
  if (!context.playing || context.speed == 1) return;
  std::array<char, 24> text{};
  std::snprintf(text.data(), text.size(), "%g\u00D7", context.speed);
  bar.push_back({3, scaled(8), text_width(text.data()), [text = std::string(text.data())] {
                   text_in_line(text, color::kAccent, "speed of playing; J slower or backwards, L faster");
                 }});
}

void add_waypoint_buttons(Bar& bar, const ViewContext& context) {
  bar.push_back(button(3, scaled(10), "add", Icon::plus, "add a waypoint at the playhead (Enter)", false,
                       [&] { add_waypoint_here(context); }));
  const bool selected = context.document.selection().kind == Selected::waypoint;
  bar.push_back({3, scaled(1), icon_button_width(),
                 [&context, selected] {
                   ImGui::BeginDisabled(!selected);
                   if (icon_button("delete", Icon::trash, "delete the selected waypoint (Delete)"))
                     delete_selected(context);
                   ImGui::EndDisabled();
                 },
                 "delete"});
}

std::string range_tooltip(const ViewContext& context) {
  const int count = context.document.range_last() - context.document.range_first() + 1;
  return "what is played and exported: " + count_text(count, "frame");
}

void add_marks(Bar& bar, const ViewContext& context) {
  const Document& document = context.document;
  const bool any = document.in() || document.out();
  const auto number = [&](int frame, bool set, float gap) {
    const std::string text = std::to_string(frame);
    bar.push_back({7, gap, text_width(text), [text, set, tooltip = range_tooltip(context)] {
                     text_in_line(text, set ? color::kText : color::kQuiet, tooltip.c_str());
                   }});
  };
  bar.push_back(button(7, scaled(10), "in", Icon::mark_in, "mark in: start here (I)", document.in().has_value(),
                       [&] { context.edits.set_in_out(document.playhead(), document.out()); }));
  number(document.range_first(), document.in().has_value(), scaled(2));
  number(document.range_last(), document.out().has_value(), scaled(12));
  bar.push_back(button(7, scaled(2), "out", Icon::mark_out, "mark out: end here (O)", document.out().has_value(),
                       [&] { context.edits.set_in_out(document.in(), document.playhead()); }));
  if (any)
    bar.push_back(button(7, scaled(1), "unmark", Icon::cross, "unmark in and out (X)", false,
                         [&] { context.edits.set_in_out(std::nullopt, std::nullopt); }));
}

}  // namespace

std::optional<int> frame_from_entry(std::string_view entry, int playhead, std::span<const double> times_s) {
  const std::string_view text = trimmed(entry);
  if (text.empty()) return std::nullopt;
  const bool is_time = text.find(':') != std::string_view::npos;
  const bool is_relative = text.front() == '+' || text.front() == '-';
  const std::optional<double> value = is_time ? time_in(text) : number(text.substr(is_relative ? 1 : 0));
  if (!value || (is_time && times_s.empty())) return std::nullopt;
  double frame = *value;
  if (is_time) frame = nearest_in_time(*value, times_s);
  if (is_relative) frame = text.front() == '-' ? playhead - *value : playhead + *value;
  const double highest = times_s.empty() ? kMaxFrames : static_cast<double>(times_s.size() - 1);
  return static_cast<int>(std::floor(std::clamp(frame, 0.0, highest)));
}

void TransportBar::draw_frame_field(const ViewContext& context, float width) {
  const int playhead = context.document.playhead();
  if (!typing_) std::snprintf(entry_.data(), entry_.size(), "%d", playhead);
  ImGui::SetNextItemWidth(width);
  ImGui::InputText("##frame", entry_.data(), entry_.size(), ImGuiInputTextFlags_AutoSelectAll);
  if (ImGui::IsItemActivated() && context.playing) context.edits.ask(Play{0});
  if (ImGui::IsItemDeactivatedAfterEdit()) {
    static const std::vector<double> kNoTimes;
    const Scene* const scene = shown_scene(context);
    const auto& times_s = scene != nullptr ? counted_frames(*scene).footage.times_s : kNoTimes;
    if (const std::optional<int> frame = frame_from_entry(entry_.data(), playhead, times_s))
      go_by_hand(context, *frame);
  }
  typing_ = ImGui::IsItemActive();
  if (!typing_) tooltip_for_item("the playhead's frame; type another one, +10 or -10 from here, or a time as 0:05.32");
}

void TransportBar::draw(const ViewContext& context) {
  const Document& document = context.document;
  const std::string time = time_text_of(context, document.playhead());
  const std::string last = std::string("/ ").append(std::to_string(std::max(0, document.frame_count() - 1)));
  const float digits = std::max(4.0F, static_cast<float>(std::to_string(document.frame_count()).size() + 1));
  const float field = text_width("0") * digits + 2 * ImGui::GetStyle().FramePadding.x;
  Bar bar;
  add_transport(bar, context);
  if (!time.empty())
    bar.push_back({6, scaled(10), std::ceil(text_width("00:00.00")),
                   [&] { text_in_line(time, color::kText, "time of the frame in the footage"); }});
  bar.push_back({1, scaled(8), field, [&] { draw_frame_field(context, field); }, "frame"});
  bar.push_back(
      {8, scaled(5), text_width(last), [&] { text_in_line(last, color::kQuiet, "the footage's last frame"); }});
  add_speed(bar, context);
  add_waypoint_buttons(bar, context);
  add_marks(bar, context);
  draw_those_that_fit(context, bar);
}

}  // namespace sigs::editor
