// SPDX-License-Identifier: MIT
#include "editor/views/timeline/ruler.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "editor/views/waypoint_actions.h"

namespace sigs::editor {

namespace {

void darken(ImDrawList& list, ImVec2 low, ImVec2 high, ImU32 shade) {
  if (high.x > low.x) list.AddRectFilled(low, high, shade);
}

constexpr double kFiner = 0.1;
constexpr double kBar_px = 9;
constexpr double kCached_px = 3;

int last_of_footage(const ViewContext& context) {
  return std::max(0, context.document.frame_count() - 1);
}

// Where the playhead's frame number stands at the head of its line.
struct Tab {
  float left = 0;
  float right = 0;
  std::string number;
};

Tab playhead_tab(const ViewContext& context, const TimelineStrip& strip) {
  ImGui::PushFont(font(Font::small));
  Tab tab{.number = std::to_string(context.document.playhead())};
  const float half = std::max(ImGui::CalcTextSize(tab.number.c_str()).x / 2 + scaled(5), scaled(12));
  const float x = strip.moment_x(context.document.playhead());
  const bool near = x >= strip.left() - half && x <= strip.right() + half;
  const float middle =
      near ? std::clamp(x, strip.left() + half, std::max(strip.left() + half, strip.right() - half)) : x;
  tab.left = middle - half;
  tab.right = middle + half;
  ImGui::PopFont();
  return tab;
}

void draw_tab(ImDrawList& list, const Tab& tab, float top_y, float bottom_y) {
  ImGui::PushFont(font(Font::small));
  const ImVec2 size = ImGui::CalcTextSize(tab.number.c_str());
  list.AddRectFilled({tab.left, top_y}, {tab.right, bottom_y}, color::kAccent, scaled(3));
  list.AddText({std::floor((tab.left + tab.right - size.x) / 2), std::floor(top_y + (bottom_y - top_y - size.y) / 2)},
               color::kCanvas, tab.number.c_str());
  ImGui::PopFont();
}

// Frame number and time beside a tick, but not where the tab is.
void draw_tick_label(ImDrawList& list, const ViewContext& context, const Tab& tab, int frame, ImVec2 at, float right) {
  const auto put = [&](const std::string& text, ImU32 shade) {
    const float width = ImGui::CalcTextSize(text.c_str()).x;
    const bool beside_tab = at.x + width < tab.left || at.x > tab.right;
    if (beside_tab && at.x + width <= right) list.AddText(at, shade, text.c_str());
    at.x += width + scaled(5);
  };
  put(std::to_string(frame), color::kText);
  if (frame <= last_of_footage(context)) put(time_text_of(context, frame), color::kQuiet);
}

void draw_ticks(ImDrawList& list, const ViewContext& context, const TimelineStrip& strip, const Tab& tab, float top_y,
                float bottom_y) {
  ImGui::PushFont(font(Font::small));
  const float space = scaled(5);
  const float widest = ImGui::CalcTextSize("10000 00:00.00").x + 3 * space;
  for (const Tick& tick : ticks(strip.ruler, widest)) {
    if (tick.frame < 0) continue;
    const float x = std::floor(strip.moment_x(tick.frame));
    const float tick_top = tick.labelled ? top_y + scaled(2) : bottom_y - scaled(4);
    list.AddRectFilled({x, tick_top}, {x + 1, bottom_y}, color::kFaint);
    if (tick.labelled)
      draw_tick_label(list, context, tab, static_cast<int>(tick.frame), {x + space, top_y}, strip.right());
  }
  ImGui::PopFont();
}

// Runs of frames that are composited and in memory, no finer than a pixel.
void draw_cached(ImDrawList& list, const ViewContext& context, const TimelineStrip& strip, float y) {
  const std::vector<bool>& cached = context.shown.cached;
  const auto size = static_cast<int>(cached.size());
  const int from = std::clamp(static_cast<int>(strip.ruler.first), 0, size);
  const int to = std::clamp(static_cast<int>(std::ceil(strip.ruler.first + strip.ruler.count)), from, size);
  const auto height = scaled(kCached_px);
  list.AddRectFilled({strip.left(), y}, {strip.right(), y + height}, faded(color::kFaint, 0.05));
  const auto draw_run = [&](int first, int end) {
    const float low = std::max(strip.left(), strip.edge_x(first));
    const float high = std::min(strip.right(), std::max(low + 1, strip.edge_x(end)));
    list.AddRectFilled({low, y}, {high, y + height}, faded(color::kGood, 0.7));
  };
  int first = -1;
  for (int frame = from; frame < to; ++frame) {
    const bool is_cached = cached[static_cast<std::size_t>(frame)];
    if (is_cached && first < 0) first = frame;
    if (!is_cached && first >= 0) draw_run(std::exchange(first, -1), frame);
  }
  if (first >= 0) draw_run(first, to);
}

// The range that is played and exported, with a handle at either end.
void draw_range_bar(ImDrawList& list, const ViewContext& context, const TimelineStrip& strip, float y, float hot_x) {
  const Document& document = context.document;
  const float height = scaled(kBar_px);
  const float handle = scaled(9);
  const float in_x = strip.edge_x(document.range_first());
  const float out_x = strip.edge_x(document.range_last() + 1.0);
  list.AddRectFilled({strip.left(), y}, {strip.right(), y + height}, IM_COL32(255, 255, 255, 10));
  list.AddRectFilled({std::max(in_x, strip.left()), y}, {std::min(out_x, strip.right()), y + height},
                     faded(color::kAccent, 0.22));
  const auto shade = [&](bool set, float x) {
    return x == hot_x ? color::kText : set ? color::kAccent : faded(color::kAccent, 0.65);
  };
  list.AddTriangleFilled({in_x, y}, {in_x + handle, y}, {in_x, y + height}, shade(document.in().has_value(), in_x));
  list.AddTriangleFilled({out_x, y}, {out_x, y + height}, {out_x - handle, y},
                         shade(document.out().has_value(), out_x));
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
  return time_text(time_of(context, frame));
}

float RulerRow::height() {
  return std::ceil(font(Font::small)->FontSize + scaled(4 + kBar_px + kCached_px + 1));
}

void RulerRow::scrub(const ViewContext& context, const TimelineStrip& strip, bool pressed) {
  const ImGuiIO& io = ImGui::GetIO();
  if (pressed || !io.KeyShift) scrub_x_ = io.MousePos.x;
  if (!pressed && io.KeyShift) scrub_x_ += io.MouseDelta.x * kFiner;
  go_by_hand(context, strip.ruler.nearest_frame(scrub_x_, 0, last_of_footage(context)));
}

void RulerRow::scrub_on_item(const ViewContext& context, const TimelineStrip& strip) {
  if (ImGui::IsItemActivated()) held_ = Held::playhead;
  scrub_while_held(context, strip);
  if (ImGui::IsItemDeactivated()) held_ = Held::none;
}

// Also in the update in which the button is let go: the mouse may have moved since the update before.
void RulerRow::scrub_while_held(const ViewContext& context, const TimelineStrip& strip) {
  if (held_ == Held::playhead && (ImGui::IsItemActive() || ImGui::IsItemDeactivated()))
    scrub(context, strip, ImGui::IsItemActivated());
}

void RulerRow::handle_mouse(const ViewContext& context, const TimelineStrip& strip, float bar_top_y) {
  const Document& document = context.document;
  const ImVec2 mouse = ImGui::GetIO().MousePos;
  const float in_x = strip.edge_x(document.range_first());
  const float out_x = strip.edge_x(document.range_last() + 1.0);
  const float reach = scaled(8);
  const bool on_bar = mouse.y >= bar_top_y;
  // Handles point inwards; where they meet, the nearer one.
  const bool near_in = on_bar && std::abs(mouse.x - in_x - reach / 2) < reach;
  const bool near_out = on_bar && std::abs(mouse.x - out_x + reach / 2) < reach;
  const bool out_nearer = std::abs(mouse.x - out_x) < std::abs(mouse.x - in_x);
  const Held under = near_out && (!near_in || out_nearer) ? Held::out : near_in ? Held::in : Held::playhead;
  if (ImGui::IsItemHovered() && under != Held::playhead) ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
  if (ImGui::IsItemActivated()) held_ = under;
  scrub_while_held(context, strip);
  if (ImGui::IsItemActive()) {
    const int edge = static_cast<int>(std::lround(std::clamp(strip.ruler.frame_at(mouse.x), -1e6, 1e9)));
    const int first = document.first_frame();
    const int last = document.last_frame();
    if (held_ == Held::in && ImGui::IsMouseDragging(ImGuiMouseButton_Left, 2)) {
      const int in = std::clamp(edge, first, document.range_last());
      context.edits.set_in_out(in == first ? std::nullopt : std::optional(in), document.out());
    }
    if (held_ == Held::out && ImGui::IsMouseDragging(ImGuiMouseButton_Left, 2)) {
      const int out = std::clamp(edge - 1, document.range_first(), last);
      context.edits.set_in_out(document.in(), out == last ? std::nullopt : std::optional(out));
    }
  }
  if (ImGui::IsItemDeactivated()) held_ = Held::none;
}

void RulerRow::draw_menu(const ViewContext& context, const TimelineStrip& strip) {
  const Document& document = context.document;
  if (ImGui::IsItemClicked(ImGuiMouseButton_Right)) {
    menu_frame_ = strip.ruler.nearest_frame(ImGui::GetIO().MousePos.x, document.first_frame(), document.last_frame());
    ImGui::OpenPopup("ruler menu");
  }
  if (!ImGui::BeginPopup("ruler menu")) return;
  ImGui::TextDisabled("frame %d", menu_frame_);
  ImGui::Separator();
  if (ImGui::MenuItem("Go there")) go_by_hand(context, menu_frame_);
  if (ImGui::MenuItem("Mark in", "I")) context.edits.set_in_out(menu_frame_, document.out());
  if (ImGui::MenuItem("Mark out", "O")) context.edits.set_in_out(document.in(), menu_frame_);
  if (ImGui::MenuItem("Unmark", "X", false, document.in() || document.out()))
    context.edits.set_in_out(std::nullopt, std::nullopt);
  ImGui::EndPopup();
}

void RulerRow::draw(const ViewContext& context, const TimelineStrip& strip) {
  const float top_y = ImGui::GetCursorScreenPos().y;
  const float bottom_y = top_y + height();
  const float bar_y = bottom_y - scaled(kBar_px + kCached_px);
  ImGui::SetCursorScreenPos({strip.left(), top_y});
  ImGui::InvisibleButton("ruler", {std::max(1.0F, strip.right() - strip.left()), height()});
  context.ui_probe.note_item("timeline/ruler");
  handle_mouse(context, strip, bar_y);
  const bool on_bar = ImGui::GetIO().MousePos.y >= bar_y;
  if (on_bar && held_ == Held::none) tooltip_for_item("drag the ends to mark in and out; green: composited and ready");
  draw_menu(context, strip);

  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.PushClipRect({strip.left(), top_y}, {strip.right(), bottom_y}, true);
  list.AddRectFilled({strip.left(), top_y}, {strip.right(), bottom_y}, color::kCanvas);
  darken_outside_project(list, strip, context.document, top_y, bar_y);
  const Tab tab = playhead_tab(context, strip);
  draw_ticks(list, context, strip, tab, top_y + scaled(1), bar_y);
  float hot_x = -1;
  if (held_ == Held::in) hot_x = strip.edge_x(context.document.range_first());
  if (held_ == Held::out) hot_x = strip.edge_x(context.document.range_last() + 1.0);
  draw_range_bar(list, context, strip, bar_y, hot_x);
  draw_cached(list, context, strip, bottom_y - scaled(kCached_px));
  darken_outside_marks(list, strip, context.document, top_y, bar_y);
  draw_playhead_line(list, strip, context.document.playhead(), top_y, bottom_y);
  draw_tab(list, tab, top_y, bar_y - scaled(1));
  list.PopClipRect();
}

}  // namespace sigs::editor
