// SPDX-License-Identifier: MIT
#pragma once

#include <imgui.h>

#include <initializer_list>

namespace sigs::editor {

// Draws icons in a square from -1 to 1, y down.
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

}  // namespace sigs::editor
