// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <optional>
#include <span>

namespace sigs::editor {

struct PickPoint {
  std::optional<glm::dvec2> at;  // on the screen; none: not in sight
  double depth_m = 0;            // before the eye
};

// The point nearest to the mouse and no farther than the reach. Of points that are as near to within a pixel, the one
// nearest to the eye; of those, the first.
[[nodiscard]] std::optional<std::size_t> nearest_point(std::span<const PickPoint> points, const glm::dvec2& mouse,
                                                       double reach_px);

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

// Which share of a segment of the world shows at a share of it on the screen, in perspective: the far half looks
// shorter.
[[nodiscard]] double share_in_world(double share_on_screen, double first_depth_m, double last_depth_m);

}  // namespace sigs::editor
