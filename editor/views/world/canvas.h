// SPDX-License-Identifier: MIT
#pragma once

#include <imgui.h>

#include <array>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "editor/geometry/orbit_camera.h"
#include "editor/geometry/screen_marks.h"
#include "editor/widgets/screen_vec.h"
#include "editor/widgets/theme.h"

namespace sigs::editor {

// Draws things of the world where the screen shows them, in one update. Points are in the world frame in metres, widths
// in pixels where the text is 15 px high. Labels that would cover another one or stick out are left out, so the
// important ones come first.
class WorldCanvas {
 public:
  WorldCanvas(ImDrawList& list, const OrbitCamera& eye, const ScreenRect& rect) : list_(list), eye_(eye), rect_(rect) {}

  [[nodiscard]] ImDrawList& list() { return list_; }
  [[nodiscard]] const OrbitCamera& eye() const { return eye_; }
  [[nodiscard]] const ScreenRect& rect() const { return rect_; }
  // Where the screen shows a point. Nothing for what is behind the eye or not within the rect, with some margin.
  [[nodiscard]] std::optional<glm::dvec2> in_sight(const glm::dvec3& p_in_world, double margin_px = 0) const;

  // What of a line lies within the rect.
  [[nodiscard]] std::optional<std::array<glm::dvec2, 2>> within_rect(const glm::dvec3& a_m,
                                                                     const glm::dvec3& b_m) const;

  // What passes behind the eye is cut off; the same with the two below.
  void line(const glm::dvec3& a_m, const glm::dvec3& b_m, ImU32 color, double width = 1);
  void dashes(const glm::dvec3& a_m, const glm::dvec3& b_m, ImU32 color, double width = 1);
  void polyline(std::span<const glm::dvec3> points_m, ImU32 color, double width = 1);

  enum class Side { right, centre };
  // Beside or around a place of the screen; false: there was no room, and nothing is drawn.
  bool label(const glm::dvec2& at, const std::string& text, ImU32 color, Side side = Side::right,
             Font font = Font::small);
  // Beside a place of the screen, that far from it, on whichever side there is room.
  bool label_beside(const glm::dvec2& at, double gap_px, const std::string& text, ImU32 color);
  // No label may cover this.
  void keep_free(const ScreenRect& area) { labels_.keep_free(area); }

 private:
  // With its upper left corner there.
  bool put(const glm::dvec2& low, const std::string& text, ImU32 color, Font font);

  ImDrawList& list_;
  const OrbitCamera& eye_;
  ScreenRect rect_;
  LabelPlacer labels_{2};
};

}  // namespace sigs::editor
