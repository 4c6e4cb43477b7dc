// SPDX-License-Identifier: MIT
#include "editor/widgets/icons.h"
#include "editor/widgets/dialog.h"

#include <imgui_internal.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "editor/widgets/texts.h"
#include "editor/widgets/theme.h"

namespace sigs::editor {

namespace {

using Points = std::vector<ImVec2>;

// A part of an icon, in a square from -1 to 1, y down.
struct Stroke {
  enum class Kind { line, closed_line, corners, fill, box, filled_box, circle, dot, arc };
  Kind kind = Kind::line;
  Points points;           // of a box two opposite corners, of circles and arcs the centre
  float radius = 0;        // of a box that of its corners
  float from = 0, to = 0;  // of an arc in radians, from the right, clockwise
};

Stroke line(Points points, bool closed = false) {
  return {closed ? Stroke::Kind::closed_line : Stroke::Kind::line, std::move(points)};
}
// A line in the quarter right and below, and its mirror images in the other three.
Stroke corners(Points points) {
  return {Stroke::Kind::corners, std::move(points)};
}
Stroke fill(Points convex) {
  return {Stroke::Kind::fill, std::move(convex)};
}
Stroke box(ImVec2 low, ImVec2 high, float rounding = 0) {
  return {Stroke::Kind::box, {low, high}, rounding};
}
Stroke filled_box(ImVec2 low, ImVec2 high) {
  return {Stroke::Kind::filled_box, {low, high}};
}
Stroke circle(ImVec2 center, float radius) {
  return {Stroke::Kind::circle, {center}, radius};
}
Stroke dot(ImVec2 center, float radius) {
  return {Stroke::Kind::dot, {center}, radius};
}
Stroke arc(ImVec2 center, float radius, float from_rad, float to_rad) {
  return {Stroke::Kind::arc, {center}, radius, from_rad, to_rad};
}

const std::vector<Stroke>& strokes_of(Icon icon) {
  static const std::map<Icon, std::vector<Stroke>> kStrokes{
      {Icon::play, {fill({{-0.6F, -0.85F}, {0.85F, 0}, {-0.6F, 0.85F}})}},
      {Icon::pause, {filled_box({-0.65F, -0.8F}, {-0.2F, 0.8F}), filled_box({0.2F, -0.8F}, {0.65F, 0.8F})}},
      {Icon::back, {fill({{0.1F, -0.75F}, {0.1F, 0.75F}, {-0.85F, 0}}), filled_box({0.4F, -0.7F}, {0.68F, 0.7F})}},
      {Icon::forward,
       {fill({{-0.1F, -0.75F}, {0.85F, 0}, {-0.1F, 0.75F}}), filled_box({-0.68F, -0.7F}, {-0.4F, 0.7F})}},
      {Icon::to_start,
       {filled_box({-0.85F, -0.75F}, {-0.6F, 0.75F}), fill({{0.15F, -0.7F}, {0.15F, 0.7F}, {-0.55F, 0}}),
        fill({{0.85F, -0.7F}, {0.85F, 0.7F}, {0.15F, 0}})}},
      {Icon::to_end,
       {filled_box({0.6F, -0.75F}, {0.85F, 0.75F}), fill({{-0.15F, -0.7F}, {0.55F, 0}, {-0.15F, 0.7F}}),
        fill({{-0.85F, -0.7F}, {-0.15F, 0}, {-0.85F, 0.7F}})}},
      {Icon::loop,
       {arc({0, 0}, 0.75F, 3.5F, 5.9F), arc({0, 0}, 0.75F, 0.36F, 2.76F),
        fill({{0.95F, -0.75F}, {0.98F, -0.08F}, {0.35F, -0.2F}}),
        fill({{-0.95F, 0.75F}, {-0.98F, 0.08F}, {-0.35F, 0.2F}})}},
      {Icon::plus, {line({{-0.8F, 0}, {0.8F, 0}}), line({{0, -0.8F}, {0, 0.8F}})}},
      {Icon::trash,
       {line({{-0.85F, -0.55F}, {0.85F, -0.55F}}), line({{-0.3F, -0.6F}, {-0.3F, -0.9F}, {0.3F, -0.9F}, {0.3F, -0.6F}}),
        line({{-0.62F, -0.5F}, {-0.5F, 0.9F}, {0.5F, 0.9F}, {0.62F, -0.5F}}), line({{-0.17F, -0.15F}, {-0.15F, 0.55F}}),
        line({{0.17F, -0.15F}, {0.15F, 0.55F}})}},
      {Icon::copy,
       {box({-0.35F, -0.35F}, {0.85F, 0.85F}, 0.15F),
        line({{-0.4F, 0.35F}, {-0.85F, 0.35F}, {-0.85F, -0.85F}, {0.35F, -0.85F}, {0.35F, -0.4F}})}},
      {Icon::folder,
       {line({{-0.9F, 0.7F}, {-0.9F, -0.65F}, {-0.25F, -0.65F}, {0, -0.35F}, {0.9F, -0.35F}, {0.9F, 0.7F}}, true)}},
      {Icon::file,
       {line({{-0.65F, -0.9F}, {0.2F, -0.9F}, {0.65F, -0.45F}, {0.65F, 0.9F}, {-0.65F, 0.9F}}, true),
        line({{0.2F, -0.85F}, {0.2F, -0.45F}, {0.6F, -0.45F}})}},
      {Icon::warning,
       {line({{0, -0.85F}, {0.95F, 0.8F}, {-0.95F, 0.8F}}, true), line({{0, -0.3F}, {0, 0.25F}}),
        dot({0, 0.53F}, 0.1F)}},
      {Icon::info, {circle({0, 0}, 0.9F), line({{0, -0.1F}, {0, 0.5F}}), dot({0, -0.42F}, 0.1F)}},
      {Icon::check, {line({{-0.8F, 0.05F}, {-0.25F, 0.6F}, {0.8F, -0.6F}})}},
      {Icon::cross, {line({{-0.65F, -0.65F}, {0.65F, 0.65F}}), line({{-0.65F, 0.65F}, {0.65F, -0.65F}})}},
      {Icon::reset, {arc({0, 0.05F}, 0.75F, -2.3F, 2.5F), fill({{-0.8F, -0.85F}, {-0.2F, -0.2F}, {-0.88F, -0.15F}})}},
      {Icon::search, {circle({-0.2F, -0.2F}, 0.6F), line({{0.25F, 0.25F}, {0.9F, 0.9F}})}},
      {Icon::settings,
       {line({{-0.9F, -0.6F}, {0.9F, -0.6F}}), line({{-0.9F, 0}, {0.9F, 0}}), line({{-0.9F, 0.6F}, {0.9F, 0.6F}}),
        dot({0.35F, -0.6F}, 0.24F), dot({-0.4F, 0}, 0.24F), dot({0.1F, 0.6F}, 0.24F)}},
      {Icon::fit, {corners({{0.35F, 0.85F}, {0.85F, 0.85F}, {0.85F, 0.35F}})}},
      {Icon::aircraft,
       {fill({{-0.13F, 0.75F}, {-0.13F, -0.75F}, {0, -0.98F}, {0.13F, -0.75F}, {0.13F, 0.75F}}),
        fill({{-0.1F, -0.35F}, {-0.1F, 0.1F}, {-0.95F, 0.35F}, {-0.95F, 0.12F}}),
        fill({{0.1F, -0.35F}, {0.95F, 0.12F}, {0.95F, 0.35F}, {0.1F, 0.1F}}),
        fill({{0, 0.5F}, {0.45F, 0.85F}, {-0.45F, 0.85F}})}},
      {Icon::mark_in, {line({{0.35F, -0.8F}, {-0.25F, -0.8F}, {-0.25F, 0.8F}, {0.35F, 0.8F}})}},
      {Icon::mark_out, {line({{-0.35F, -0.8F}, {0.25F, -0.8F}, {0.25F, 0.8F}, {-0.35F, 0.8F}})}},
      {Icon::chevron_left, {line({{0.35F, -0.7F}, {-0.35F, 0}, {0.35F, 0.7F}})}},
      {Icon::box, {corners({{0.75F, 0.2F}, {0.75F, 0.6F}, {0.3F, 0.6F}})}},
      {Icon::path, {line({{-0.8F, 0.55F}, {-0.35F, -0.1F}, {0, -0.25F}, {0.35F, -0.15F}, {0.8F, -0.55F}})}},
      {Icon::waypoints, {fill({{0, -0.55F}, {0.5F, 0}, {0, 0.55F}, {-0.5F, 0}})}},
      {Icon::horizon, {line({{-0.85F, 0.25F}, {0.85F, 0.25F}}), arc({0, 0.25F}, 0.45F, 3.1415927F, 6.2831853F)}},
      {Icon::own_body,
       {box({-0.8F, -0.65F}, {0.8F, 0.65F}), fill({{-0.8F, 0.65F}, {-0.2F, 0.1F}, {0.2F, 0.1F}, {0.8F, 0.65F}})}},
      {Icon::grid,
       {line({{-0.27F, -0.75F}, {-0.27F, 0.75F}}), line({{-0.75F, -0.27F}, {0.75F, -0.27F}}),
        line({{0.27F, -0.75F}, {0.27F, 0.75F}}), line({{-0.75F, 0.27F}, {0.75F, 0.27F}})}},
      {Icon::wipe,
       {box({-0.75F, -0.55F}, {0.75F, 0.55F}), filled_box({-0.75F, -0.55F}, {0, 0.55F}),
        line({{0, -0.85F}, {0, 0.85F}})}},
      {Icon::fit_contents, {corners({{0.75F, 0.25F}, {0.75F, 0.65F}, {0.3F, 0.65F}}), dot({0, 0}, 0.16F)}},
      {Icon::target,
       {circle({0, 0}, 0.5F), line({{-0.85F, 0}, {-0.3F, 0}}), line({{0.3F, 0}, {0.85F, 0}}),
        line({{0, -0.85F}, {0, -0.3F}}), line({{0, 0.3F}, {0, 0.85F}})}},
      {Icon::brush,
       {line({{0.7F, -0.75F}, {-0.15F, 0.15F}}),
        fill({{-0.35F, 0}, {0, 0.35F}, {-0.3F, 0.7F}, {-0.8F, 0.75F}, {-0.65F, 0.3F}})}},
      {Icon::eraser,
       {line({{-0.1F, 0.65F}, {-0.75F, 0.05F}, {0.15F, -0.7F}, {0.75F, -0.1F}, {-0.1F, 0.65F}, {0.75F, 0.65F}}),
        line({{-0.3F, -0.3F}, {0.35F, 0.25F}})}},
      {Icon::undo,
       {line({{-0.7F, -0.2F},
              {0.2F, -0.2F},
              {0.55F, -0.05F},
              {0.7F, 0.25F},
              {0.55F, 0.55F},
              {0.2F, 0.7F},
              {-0.25F, 0.7F}}),
        line({{-0.3F, -0.6F}, {-0.7F, -0.2F}, {-0.3F, 0.2F}})}},
      {Icon::redo,
       {line({{0.7F, -0.2F},
              {-0.2F, -0.2F},
              {-0.55F, -0.05F},
              {-0.7F, 0.25F},
              {-0.55F, 0.55F},
              {-0.2F, 0.7F},
              {0.25F, 0.7F}}),
        line({{0.3F, -0.6F}, {0.7F, -0.2F}, {0.3F, 0.2F}})}},
      {Icon::orbit,
       {line({{0, -0.85F}, {0.75F, -0.45F}, {0.75F, 0.45F}, {0, 0.85F}, {-0.75F, 0.45F}, {-0.75F, -0.45F}}, true),
        line({{-0.75F, -0.45F}, {0, -0.05F}, {0.75F, -0.45F}}), line({{0, -0.05F}, {0, 0.85F}})}},
      {Icon::view_from_top,
       {box({-0.7F, -0.1F}, {0.7F, 0.85F}), line({{0, -0.95F}, {0, -0.35F}}),
        line({{-0.28F, -0.6F}, {0, -0.3F}, {0.28F, -0.6F}})}},
      {Icon::view_from_side,
       {box({0.0F, -0.7F}, {0.9F, 0.7F}), line({{-0.95F, 0}, {-0.3F, 0}}),
        line({{-0.55F, -0.28F}, {-0.25F, 0}, {-0.55F, 0.28F}})}},
      {Icon::camera,
       {box({-0.9F, -0.5F}, {0.3F, 0.5F}, 0.2F), line({{0.3F, -0.1F}, {0.9F, -0.5F}, {0.9F, 0.5F}, {0.3F, 0.1F}})}},
      {Icon::perspective,
       {line({{-0.35F, -0.7F}, {0.35F, -0.7F}, {0.9F, 0.7F}, {-0.9F, 0.7F}}, true), line({{0, -0.7F}, {0, 0.7F}}),
        line({{-0.55F, -0.15F}, {0.55F, -0.15F}})}},
      {Icon::snap,
       {line({{-0.65F, -0.8F}, {-0.65F, 0.1F}, {-0.4F, 0.6F}, {0, 0.8F}, {0.4F, 0.6F}, {0.65F, 0.1F}, {0.65F, -0.8F}}),
        line({{-0.85F, -0.45F}, {-0.45F, -0.45F}}), line({{0.45F, -0.45F}, {0.85F, -0.45F}})}},
      {Icon::cylinder,
       {line({{-0.8F, -0.45F}, {-0.4F, -0.7F}, {0.4F, -0.7F}, {0.8F, -0.45F}, {0.4F, -0.2F}, {-0.4F, -0.2F}}, true),
        line({{-0.8F, -0.45F}, {-0.8F, 0.5F}, {-0.4F, 0.75F}, {0.4F, 0.75F}, {0.8F, 0.5F}, {0.8F, -0.45F}})}},
      {Icon::more, {dot({-0.714F, 0}, 0.214F), dot({0, 0}, 0.214F), dot({0.714F, 0}, 0.214F)}},
  };
  return kStrokes.at(icon);
}

// Puts strokes onto the screen: an icon's square there, and how wide its lines are.
struct IconPen {
  ImDrawList& list;
  ImVec2 center;
  float half = 0;
  float width = 1;
  ImU32 color = 0;

  [[nodiscard]] ImVec2 at(ImVec2 p) const { return {center.x + p.x * half, center.y + p.y * half}; }
  void path(const Points& points, ImVec2 mirror = {1, 1}) const {
    for (const ImVec2 point : points) list.PathLineTo(at({point.x * mirror.x, point.y * mirror.y}));
  }
  void draw(const Stroke& stroke) const {
    const Points& points = stroke.points;
    const float radius = stroke.radius * half;
    switch (stroke.kind) {
      case Stroke::Kind::line:
      case Stroke::Kind::closed_line:
        path(points);
        return list.PathStroke(color, stroke.kind == Stroke::Kind::line ? ImDrawFlags_None : ImDrawFlags_Closed, width);
      case Stroke::Kind::corners:
        for (const ImVec2 mirror : {ImVec2(-1, -1), ImVec2(-1, 1), ImVec2(1, -1), ImVec2(1, 1)}) {
          path(points, mirror);
          list.PathStroke(color, ImDrawFlags_None, width);
        }
        return;
      case Stroke::Kind::fill:
        path(points);
        return list.PathFillConvex(color);
      case Stroke::Kind::box:
        return list.AddRect(at(points[0]), at(points[1]), color, radius, ImDrawFlags_None, width);
      case Stroke::Kind::filled_box:
        return list.AddRectFilled(at(points[0]), at(points[1]), color);
      case Stroke::Kind::circle:
        return list.AddCircle(at(points[0]), radius, color, 0, width);
      case Stroke::Kind::dot:
        return list.AddCircleFilled(at(points[0]), std::max(width * 0.7F, radius), color);
      case Stroke::Kind::arc:
        list.PathArcTo(at(points[0]), radius, stroke.from, stroke.to, 14);
        return list.PathStroke(color, ImDrawFlags_None, width);
    }
  }
};

constexpr float kRestBeforeTooltip_s = 0.35F;

}  // namespace

void draw_diamond(ImDrawList& list, ImVec2 c, float r, ImU32 color) {
  list.AddQuadFilled({c.x, c.y - r}, {c.x + r, c.y}, {c.x, c.y + r}, {c.x - r, c.y}, color);
}

void draw_diamond(ImDrawList& list, ImVec2 c, float r, ImU32 color, float line_width) {
  list.AddQuad({c.x, c.y - r}, {c.x + r, c.y}, {c.x, c.y + r}, {c.x - r, c.y}, color, line_width);
}

void draw_icon(ImDrawList& list, Icon icon, ImVec2 center, float size, ImU32 color) {
  // On whole pixels, so that upright lines are sharp.
  const IconPen pen{.list = list,
                    .center = {std::floor(center.x) + 0.5F, std::floor(center.y) + 0.5F},
                    .half = size * 0.42F,
                    .width = std::max(1.0F, size * 0.085F),
                    .color = color};
  for (const Stroke& stroke : strokes_of(icon)) pen.draw(stroke);
}

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
  draw_icon(*ImGui::GetWindowDrawList(), icon, center, ImGui::GetFontSize() * 1.1F, shade);
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
