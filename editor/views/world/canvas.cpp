// SPDX-License-Identifier: MIT
#include "editor/views/world/scene.h"

#include <algorithm>
#include <cmath>

namespace sigs::editor {

namespace {

constexpr double kMinStep_px = 1.5;  // what lies nearer to the point before adds nothing to a polyline

bool holds(const ScreenRect& outer, const ScreenRect& inner) {
  return inner.low.x >= outer.low.x && inner.low.y >= outer.low.y && inner.high.x <= outer.high.x &&
         inner.high.y <= outer.high.y;
}

}  // namespace

std::optional<glm::dvec2> WorldCanvas::in_sight(const glm::dvec3& p_in_world, double margin_px) const {
  const std::optional<glm::dvec2> at = eye_.screen_of(p_in_world, rect_);
  if (!at || !ScreenRect{rect_.low - margin_px, rect_.high + margin_px}.contains(*at)) return std::nullopt;
  return at;
}

std::optional<std::array<glm::dvec2, 2>> WorldCanvas::within_rect(const glm::dvec3& a_m, const glm::dvec3& b_m) const {
  const auto line = screen_line(eye_, rect_, a_m, b_m);
  return line ? line_within(*line, rect_) : std::nullopt;
}

void WorldCanvas::line(const glm::dvec3& a_m, const glm::dvec3& b_m, ImU32 color, double width) {
  if (const auto ends = screen_line(eye_, rect_, a_m, b_m))
    list_.AddLine(im((*ends)[0]), im((*ends)[1]), color, scaled(width));
}

void WorldCanvas::dashes(const glm::dvec3& a_m, const glm::dvec3& b_m, ImU32 color, double width) {
  constexpr int kMaxDashes = 200;
  const auto ends = screen_line(eye_, rect_, a_m, b_m);
  if (!ends) return;
  const double length = glm::distance((*ends)[0], (*ends)[1]);
  const double period = std::max<double>(scaled(9), length / kMaxDashes);
  for (double along = 0; along < length; along += period) {
    const glm::dvec2 from = glm::mix((*ends)[0], (*ends)[1], along / length);
    const glm::dvec2 to = glm::mix((*ends)[0], (*ends)[1], std::min(1.0, (along + period * 0.55) / length));
    list_.AddLine(im(from), im(to), color, scaled(width));
  }
}

// Cut lines begin a stroke of their own, the rest goes as one.
void WorldCanvas::polyline(std::span<const glm::dvec3> points_m, ImU32 color, double width) {
  std::vector<ImVec2> stroke;
  glm::dvec2 last{0, 0};
  const auto finish = [&] {
    if (stroke.size() > 1)
      list_.AddPolyline(stroke.data(), static_cast<int>(stroke.size()), color, ImDrawFlags_None, scaled(width));
    stroke.clear();
  };
  for (std::size_t i = 1; i < points_m.size(); ++i) {
    const auto ends = screen_line(eye_, rect_, points_m[i - 1], points_m[i]);
    if (!ends) {
      finish();
      continue;
    }
    if (!stroke.empty() && glm::distance(last, (*ends)[0]) > kMinStep_px) finish();
    if (stroke.empty()) stroke.push_back(im(last = (*ends)[0]));
    const bool is_end = i + 1 == points_m.size();
    if (is_end || glm::distance(last, (*ends)[1]) >= kMinStep_px) stroke.push_back(im(last = (*ends)[1]));
  }
  finish();
}

bool WorldCanvas::put(const glm::dvec2& low, const std::string& text, ImU32 color, Font which) {
  ImFont* face = font(which);
  const ScreenRect place{low, low + text_size(text, which)};
  if (!holds(rect_, place) || !labels_.place({&place, 1})) return false;
  const ImVec2 corner{std::round(static_cast<float>(place.low.x)), std::round(static_cast<float>(place.low.y))};
  list_.AddText(face, face->FontSize, {corner.x + 1, corner.y + 1}, IM_COL32(0, 0, 0, 160), text.c_str());
  list_.AddText(face, face->FontSize, corner, color, text.c_str());
  return true;
}

bool WorldCanvas::label(const glm::dvec2& at, const std::string& text, ImU32 color, Side side, Font which) {
  const glm::dvec2 size = text_size(text, which);
  return put(at - size * glm::dvec2(side == Side::right ? 0 : 0.5, 0.5), text, color, which);
}

bool WorldCanvas::label_beside(const glm::dvec2& at, double gap_px, const std::string& text, ImU32 color) {
  const glm::dvec2 size = text_size(text, Font::small);
  const glm::dvec2 slanted = glm::dvec2(gap_px, 0.25 * gap_px);
  const glm::dvec2 half = size / 2.0;
  for (const glm::dvec2 side : {glm::dvec2(1, -1), glm::dvec2(1, 1), glm::dvec2(-1, -1), glm::dvec2(-1, 1)})
    if (put(at + side * (half + slanted) - half, text, color, Font::small)) return true;
  for (const glm::dvec2 side : {glm::dvec2(0, -1), glm::dvec2(0, 1), glm::dvec2(1, 0), glm::dvec2(-1, 0)})
    if (put(at + side * (half + gap_px) - half, text, color, Font::small)) return true;
  return false;
}

}  // namespace sigs::editor
