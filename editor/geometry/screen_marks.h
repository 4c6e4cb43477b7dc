// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "editor/geometry/image_view.h"

namespace sigs::editor {

// A point of the world that the mouse may pick, as the screen shows it.
struct PickPoint {
  std::optional<glm::dvec2> at;  // on the screen; none: not in sight
  double depth_m = 0;            // before the eye
};

// The point nearest to the mouse and no farther than the reach. Of points that are as near to within a pixel, the one
// nearest to the eye; of those, the first.
[[nodiscard]] std::optional<std::size_t> nearest_point(std::span<const PickPoint> points, const glm::dvec2& mouse,
                                                       double reach_px);

// A place of a polyline on the screen (window pixels).
struct PlaceOnLine {
  std::size_t segment = 0;  // from point `segment` to the next
  double share = 0;         // of the segment on the screen, 0..1
  glm::dvec2 at{0, 0};
  double distance_px = 0;  // from the mouse
};

// The place of a polyline on the screen that is nearest to the mouse, within the reach; segments with an end out of
// sight do not count.
[[nodiscard]] std::optional<PlaceOnLine> nearest_place(std::span<const std::optional<glm::dvec2>> line,
                                                       const glm::dvec2& mouse, double reach_px);

// The share of a segment in the world (0 at its first end, 1 at its last) that appears at a share of it on the screen,
// in perspective. The depths of the ends are those before the eye, in metres.
[[nodiscard]] double share_in_world(double share_on_screen, double first_depth_m, double last_depth_m);

// Thins marks that are drawn in order: a mark nearer than min_px (screen pixels) to the last one drawn is left out.
class Thinning {
 public:
  explicit Thinning(double min_px) : min_px_(min_px) {}

  // True: leave it out. False: it is drawn, and what follows is compared with it.
  [[nodiscard]] bool leaves_out(const glm::dvec2& at) {
    if (glm::distance(last_, at) < min_px_) return true;
    last_ = at;
    return false;
  }

 private:
  double min_px_;
  glm::dvec2 last_{std::numeric_limits<double>::infinity()};  // none yet: far from everything
};

// Finds places for labels so that none covers another one or an area that has to stay free.
class LabelPlacer {
 public:
  // margin_px: kept free around each label as well.
  explicit LabelPlacer(double margin_px = 0) : margin_px_(margin_px) {}

  // No label placed later may overlap this area.
  void keep_free(const ScreenRect& area) { taken_.push_back(area); }

  // The first candidate that overlaps nothing; that area is taken from then on. Where there is none: the first
  // candidate of all with in_any_case, else nothing.
  [[nodiscard]] std::optional<ScreenRect> place(std::span<const ScreenRect> candidates, bool in_any_case = false);

 private:
  double margin_px_;
  std::vector<ScreenRect> taken_;
};

}  // namespace sigs::editor
