// SPDX-License-Identifier: MIT
#include "editor/widgets/icons.h"
#include "editor/widgets/dialog.h"

#include <imgui_internal.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "editor/widgets/texts.h"
#include "editor/widgets/theme.h"

namespace sigs::editor {

namespace {

// Draws in a square from -1 to 1, y down.
class IconPen {
 public:
  IconPen(ImDrawList& list, ImVec2 center, float size, ImU32 color);

  void line(std::initializer_list<ImVec2> points, bool closed = false);
  void fill(std::initializer_list<ImVec2> corners);  // convex
  void box(ImVec2 low, ImVec2 high, float rounding = 0);
  void filled_box(ImVec2 low, ImVec2 high);
  void circle(ImVec2 center, float radius);
  void dot(ImVec2 center, float radius);
  void arc(ImVec2 center, float radius, float from_rad, float to_rad);  // from the right, clockwise

 private:
  [[nodiscard]] ImVec2 at(ImVec2 p) const { return {center_.x + p.x * half_, center_.y + p.y * half_}; }

  ImDrawList& list_;
  ImVec2 center_;
  float half_;
  float stroke_;
  ImU32 color_;
};

IconPen::IconPen(ImDrawList& list, ImVec2 center, float size, ImU32 color)
    : list_(list), center_(center), half_(size * 0.42F), stroke_(std::max(1.0F, size * 0.085F)), color_(color) {}

void IconPen::line(std::initializer_list<ImVec2> points, bool closed) {
  for (const ImVec2 point : points) list_.PathLineTo(at(point));
  list_.PathStroke(color_, closed ? ImDrawFlags_Closed : ImDrawFlags_None, stroke_);
}

void IconPen::fill(std::initializer_list<ImVec2> corners) {
  for (const ImVec2 corner : corners) list_.PathLineTo(at(corner));
  list_.PathFillConvex(color_);
}

void IconPen::box(ImVec2 low, ImVec2 high, float rounding) {
  list_.AddRect(at(low), at(high), color_, rounding * half_, ImDrawFlags_None, stroke_);
}

void IconPen::filled_box(ImVec2 low, ImVec2 high) {
  list_.AddRectFilled(at(low), at(high), color_);
}

void IconPen::circle(ImVec2 center, float radius) {
  list_.AddCircle(at(center), radius * half_, color_, 0, stroke_);
}

void IconPen::dot(ImVec2 center, float radius) {
  list_.AddCircleFilled(at(center), std::max(stroke_ * 0.7F, radius * half_), color_);
}

void IconPen::arc(ImVec2 center, float radius, float from_rad, float to_rad) {
  list_.PathArcTo(at(center), radius * half_, from_rad, to_rad, 14);
  list_.PathStroke(color_, ImDrawFlags_None, stroke_);
}

void play(IconPen& pen) {
  pen.fill({{-0.6F, -0.85F}, {0.85F, 0}, {-0.6F, 0.85F}});
}

void pause(IconPen& pen) {
  pen.filled_box({-0.65F, -0.8F}, {-0.2F, 0.8F});
  pen.filled_box({0.2F, -0.8F}, {0.65F, 0.8F});
}

void back(IconPen& pen) {
  pen.fill({{0.1F, -0.75F}, {0.1F, 0.75F}, {-0.85F, 0}});
  pen.filled_box({0.4F, -0.7F}, {0.68F, 0.7F});
}

void forward(IconPen& pen) {
  pen.fill({{-0.1F, -0.75F}, {0.85F, 0}, {-0.1F, 0.75F}});
  pen.filled_box({-0.68F, -0.7F}, {-0.4F, 0.7F});
}

void to_start(IconPen& pen) {
  pen.filled_box({-0.85F, -0.75F}, {-0.6F, 0.75F});
  pen.fill({{0.15F, -0.7F}, {0.15F, 0.7F}, {-0.55F, 0}});
  pen.fill({{0.85F, -0.7F}, {0.85F, 0.7F}, {0.15F, 0}});
}

void to_end(IconPen& pen) {
  pen.filled_box({0.6F, -0.75F}, {0.85F, 0.75F});
  pen.fill({{-0.15F, -0.7F}, {0.55F, 0}, {-0.15F, 0.7F}});
  pen.fill({{-0.85F, -0.7F}, {-0.15F, 0}, {-0.85F, 0.7F}});
}

void loop(IconPen& pen) {
  pen.arc({0, 0}, 0.75F, 3.5F, 5.9F);
  pen.arc({0, 0}, 0.75F, 0.36F, 2.76F);
  pen.fill({{0.95F, -0.75F}, {0.98F, -0.08F}, {0.35F, -0.2F}});
  pen.fill({{-0.95F, 0.75F}, {-0.98F, 0.08F}, {-0.35F, 0.2F}});
}

void plus(IconPen& pen) {
  pen.line({{-0.8F, 0}, {0.8F, 0}});
  pen.line({{0, -0.8F}, {0, 0.8F}});
}

void trash(IconPen& pen) {
  pen.line({{-0.85F, -0.55F}, {0.85F, -0.55F}});
  pen.line({{-0.3F, -0.6F}, {-0.3F, -0.9F}, {0.3F, -0.9F}, {0.3F, -0.6F}});
  pen.line({{-0.62F, -0.5F}, {-0.5F, 0.9F}, {0.5F, 0.9F}, {0.62F, -0.5F}});
  pen.line({{-0.17F, -0.15F}, {-0.15F, 0.55F}});
  pen.line({{0.17F, -0.15F}, {0.15F, 0.55F}});
}

void copy(IconPen& pen) {
  pen.box({-0.35F, -0.35F}, {0.85F, 0.85F}, 0.15F);
  pen.line({{-0.4F, 0.35F}, {-0.85F, 0.35F}, {-0.85F, -0.85F}, {0.35F, -0.85F}, {0.35F, -0.4F}});
}

void folder(IconPen& pen) {
  pen.line({{-0.9F, 0.7F}, {-0.9F, -0.65F}, {-0.25F, -0.65F}, {0, -0.35F}, {0.9F, -0.35F}, {0.9F, 0.7F}}, true);
}

void file(IconPen& pen) {
  pen.line({{-0.65F, -0.9F}, {0.2F, -0.9F}, {0.65F, -0.45F}, {0.65F, 0.9F}, {-0.65F, 0.9F}}, true);
  pen.line({{0.2F, -0.85F}, {0.2F, -0.45F}, {0.6F, -0.45F}});
}

void warning(IconPen& pen) {
  pen.line({{0, -0.85F}, {0.95F, 0.8F}, {-0.95F, 0.8F}}, true);
  pen.line({{0, -0.3F}, {0, 0.25F}});
  pen.dot({0, 0.53F}, 0.1F);
}

void info(IconPen& pen) {
  pen.circle({0, 0}, 0.9F);
  pen.line({{0, -0.1F}, {0, 0.5F}});
  pen.dot({0, -0.42F}, 0.1F);
}

void check(IconPen& pen) {
  pen.line({{-0.8F, 0.05F}, {-0.25F, 0.6F}, {0.8F, -0.6F}});
}

void cross(IconPen& pen) {
  pen.line({{-0.65F, -0.65F}, {0.65F, 0.65F}});
  pen.line({{-0.65F, 0.65F}, {0.65F, -0.65F}});
}

void reset(IconPen& pen) {
  pen.arc({0, 0.05F}, 0.75F, -2.3F, 2.5F);
  pen.fill({{-0.8F, -0.85F}, {-0.2F, -0.2F}, {-0.88F, -0.15F}});
}

void search(IconPen& pen) {
  pen.circle({-0.2F, -0.2F}, 0.6F);
  pen.line({{0.25F, 0.25F}, {0.9F, 0.9F}});
}

void settings(IconPen& pen) {
  for (const float y : {-0.6F, 0.0F, 0.6F}) pen.line({{-0.9F, y}, {0.9F, y}});
  pen.dot({0.35F, -0.6F}, 0.24F);
  pen.dot({-0.4F, 0}, 0.24F);
  pen.dot({0.1F, 0.6F}, 0.24F);
}

void fit(IconPen& pen) {
  for (const float x : {-1.0F, 1.0F})
    for (const float y : {-1.0F, 1.0F})
      pen.line({{x * 0.35F, y * 0.85F}, {x * 0.85F, y * 0.85F}, {x * 0.85F, y * 0.35F}});
}

void aircraft(IconPen& pen) {
  pen.fill({{-0.13F, 0.75F}, {-0.13F, -0.75F}, {0, -0.98F}, {0.13F, -0.75F}, {0.13F, 0.75F}});
  pen.fill({{-0.1F, -0.35F}, {-0.1F, 0.1F}, {-0.95F, 0.35F}, {-0.95F, 0.12F}});
  pen.fill({{0.1F, -0.35F}, {0.95F, 0.12F}, {0.95F, 0.35F}, {0.1F, 0.1F}});
  pen.fill({{0, 0.5F}, {0.45F, 0.85F}, {-0.45F, 0.85F}});
}

void mark_in(IconPen& pen) {
  pen.line({{0.35F, -0.8F}, {-0.25F, -0.8F}, {-0.25F, 0.8F}, {0.35F, 0.8F}});
}

void mark_out(IconPen& pen) {
  pen.line({{-0.35F, -0.8F}, {0.25F, -0.8F}, {0.25F, 0.8F}, {-0.35F, 0.8F}});
}

void chevron_left(IconPen& pen) {
  pen.line({{0.35F, -0.7F}, {-0.35F, 0}, {0.35F, 0.7F}});
}

void box(IconPen& pen) {
  for (const float x : {-1.0F, 1.0F})
    for (const float y : {-1.0F, 1.0F}) pen.line({{0.75F * x, 0.2F * y}, {0.75F * x, 0.6F * y}, {0.3F * x, 0.6F * y}});
}

void path(IconPen& pen) {
  pen.line({{-0.8F, 0.55F}, {-0.35F, -0.1F}, {0, -0.25F}, {0.35F, -0.15F}, {0.8F, -0.55F}});
}

void waypoints(IconPen& pen) {
  pen.fill({{0, -0.55F}, {0.5F, 0}, {0, 0.55F}, {-0.5F, 0}});
}

void horizon(IconPen& pen) {
  pen.line({{-0.85F, 0.25F}, {0.85F, 0.25F}});
  pen.arc({0, 0.25F}, 0.45F, 3.1415927F, 6.2831853F);
}

void own_body(IconPen& pen) {
  pen.box({-0.8F, -0.65F}, {0.8F, 0.65F});
  pen.fill({{-0.8F, 0.65F}, {-0.2F, 0.1F}, {0.2F, 0.1F}, {0.8F, 0.65F}});
}

void grid(IconPen& pen) {
  for (const float at : {-0.27F, 0.27F}) {
    pen.line({{at, -0.75F}, {at, 0.75F}});
    pen.line({{-0.75F, at}, {0.75F, at}});
  }
}

void wipe(IconPen& pen) {
  pen.box({-0.75F, -0.55F}, {0.75F, 0.55F});
  pen.filled_box({-0.75F, -0.55F}, {0, 0.55F});
  pen.line({{0, -0.85F}, {0, 0.85F}});
}

void fit_contents(IconPen& pen) {
  for (const float x : {-1.0F, 1.0F})
    for (const float y : {-1.0F, 1.0F})
      pen.line({{0.75F * x, 0.25F * y}, {0.75F * x, 0.65F * y}, {0.3F * x, 0.65F * y}});
  pen.dot({0, 0}, 0.16F);
}

void target(IconPen& pen) {
  pen.circle({0, 0}, 0.5F);
  pen.line({{-0.85F, 0}, {-0.3F, 0}});
  pen.line({{0.3F, 0}, {0.85F, 0}});
  pen.line({{0, -0.85F}, {0, -0.3F}});
  pen.line({{0, 0.3F}, {0, 0.85F}});
}

void brush(IconPen& pen) {
  pen.line({{0.7F, -0.75F}, {-0.15F, 0.15F}});
  pen.fill({{-0.35F, 0}, {0, 0.35F}, {-0.3F, 0.7F}, {-0.8F, 0.75F}, {-0.65F, 0.3F}});
}

void eraser(IconPen& pen) {
  pen.line({{-0.1F, 0.65F}, {-0.75F, 0.05F}, {0.15F, -0.7F}, {0.75F, -0.1F}, {-0.1F, 0.65F}, {0.75F, 0.65F}});
  pen.line({{-0.3F, -0.3F}, {0.35F, 0.25F}});
}

// side_sign -1: the arrow's head is at the left.
void turned_arrow(IconPen& pen, float side_sign) {
  const auto at = [side_sign](float x, float y) { return ImVec2(side_sign * -x, y); };
  pen.line({at(-0.7F, -0.2F), at(0.2F, -0.2F), at(0.55F, -0.05F), at(0.7F, 0.25F), at(0.55F, 0.55F), at(0.2F, 0.7F),
            at(-0.25F, 0.7F)});
  pen.line({at(-0.3F, -0.6F), at(-0.7F, -0.2F), at(-0.3F, 0.2F)});
}

void undo(IconPen& pen) {
  turned_arrow(pen, -1);
}

void redo(IconPen& pen) {
  turned_arrow(pen, 1);
}

void orbit(IconPen& pen) {
  pen.line({{0, -0.85F}, {0.75F, -0.45F}, {0.75F, 0.45F}, {0, 0.85F}, {-0.75F, 0.45F}, {-0.75F, -0.45F}}, true);
  pen.line({{-0.75F, -0.45F}, {0, -0.05F}, {0.75F, -0.45F}});
  pen.line({{0, -0.05F}, {0, 0.85F}});
}

void view_from_top(IconPen& pen) {
  pen.box({-0.7F, -0.1F}, {0.7F, 0.85F});
  pen.line({{0, -0.95F}, {0, -0.35F}});
  pen.line({{-0.28F, -0.6F}, {0, -0.3F}, {0.28F, -0.6F}});
}

void view_from_side(IconPen& pen) {
  pen.box({0.0F, -0.7F}, {0.9F, 0.7F});
  pen.line({{-0.95F, 0}, {-0.3F, 0}});
  pen.line({{-0.55F, -0.28F}, {-0.25F, 0}, {-0.55F, 0.28F}});
}

void camera(IconPen& pen) {
  pen.box({-0.9F, -0.5F}, {0.3F, 0.5F}, 0.2F);
  pen.line({{0.3F, -0.1F}, {0.9F, -0.5F}, {0.9F, 0.5F}, {0.3F, 0.1F}});
}

void perspective(IconPen& pen) {
  pen.line({{-0.35F, -0.7F}, {0.35F, -0.7F}, {0.9F, 0.7F}, {-0.9F, 0.7F}}, true);
  pen.line({{0, -0.7F}, {0, 0.7F}});
  pen.line({{-0.55F, -0.15F}, {0.55F, -0.15F}});
}

void snap(IconPen& pen) {
  pen.line({{-0.65F, -0.8F}, {-0.65F, 0.1F}, {-0.4F, 0.6F}, {0, 0.8F}, {0.4F, 0.6F}, {0.65F, 0.1F}, {0.65F, -0.8F}});
  pen.line({{-0.85F, -0.45F}, {-0.45F, -0.45F}});
  pen.line({{0.45F, -0.45F}, {0.85F, -0.45F}});
}

void cylinder(IconPen& pen) {
  pen.line({{-0.8F, -0.45F}, {-0.4F, -0.7F}, {0.4F, -0.7F}, {0.8F, -0.45F}, {0.4F, -0.2F}, {-0.4F, -0.2F}}, true);
  pen.line({{-0.8F, -0.45F}, {-0.8F, 0.5F}, {-0.4F, 0.75F}, {0.4F, 0.75F}, {0.8F, 0.5F}, {0.8F, -0.45F}});
}

void more(IconPen& pen) {
  for (const float x : {-0.714F, 0.0F, 0.714F}) pen.dot({x, 0}, 0.214F);
}

using Shape = void (*)(IconPen&);

// In the order of Icon.
constexpr Shape kShapes[] = {
    play,     pause,         back,           forward, to_start,     to_end,       loop,   plus,     trash,
    copy,     folder,        file,           warning, info,         check,        cross,  reset,    search,
    settings, fit,           aircraft,       mark_in, mark_out,     chevron_left, box,    path,     waypoints,
    horizon,  own_body,      grid,           wipe,    target,       brush,        eraser, undo,     redo,
    orbit,    view_from_top, view_from_side, camera,  fit_contents, perspective,  snap,   cylinder, more,
};
static_assert(std::size(kShapes) == static_cast<std::size_t>(Icon::more) + 1);

}  // namespace

void draw_icon(ImDrawList& list, Icon icon, ImVec2 center, float size, ImU32 color) {
  // On whole pixels, so that upright lines are sharp.
  IconPen pen(list, {std::floor(center.x) + 0.5F, std::floor(center.y) + 0.5F}, size, color);
  kShapes[static_cast<std::size_t>(icon)](pen);
}

namespace {

constexpr float kRestBeforeTooltip_s = 0.35F;

// The side of an icon within a button of some height.
float icon_size() {
  return ImGui::GetFontSize() * 1.1F;
}

}  // namespace

float icon_button_width() {
  return ImGui::GetFrameHeight();
}

bool icon_button(const char* id, Icon icon, const char* tooltip, bool on) {
  const float side = icon_button_width();
  ImGui::PushStyleColor(ImGuiCol_Button, on ? color::kAccentSoft : IM_COL32_BLACK_TRANS);
  ImGui::PushID(id);
  const bool clicked = ImGui::Button("##icon", {side, side});
  ImGui::PopID();
  ImGui::PopStyleColor();
  const ImVec2 low = ImGui::GetItemRectMin();
  const ImVec2 center{low.x + side / 2, low.y + side / 2};
  const ImU32 shade = ImGui::GetColorU32(on ? color::kAccent : color::kText);  // paler where disabled
  draw_icon(*ImGui::GetWindowDrawList(), icon, center, icon_size(), shade);
  tooltip_for_item(tooltip);
  return clicked;
}

void icon_label(Icon icon, ImU32 color) {
  const float side = ImGui::GetFontSize();
  const ImVec2 low = ImGui::GetCursorScreenPos();
  ImGui::Dummy({side, side});
  draw_icon(*ImGui::GetWindowDrawList(), icon, {low.x + side / 2, low.y + side / 2}, side, ImGui::GetColorU32(color));
}

bool item_wants_tooltip() {
  return ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled) &&
         ImGui::GetCurrentContext()->HoveredIdTimer >= kRestBeforeTooltip_s;
}

void tooltip_for_item(const char* text) {
  if (*text == '\0' || !item_wants_tooltip()) return;
  place_tooltip_beside_panel(ImGui::GetFontSize() * 26 + 2 * ImGui::GetStyle().WindowPadding.x);
  ImGui::BeginTooltip();
  ImGui::PushTextWrapPos(ImGui::GetFontSize() * 26);
  ImGui::TextUnformatted(shortened(text).c_str());
  ImGui::PopTextWrapPos();
  ImGui::EndTooltip();
}

}  // namespace sigs::editor
