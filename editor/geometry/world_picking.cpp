// SPDX-License-Identifier: MIT
#include "editor/geometry/world_picking.h"

#include <algorithm>
#include <limits>

namespace sigs::editor {
namespace {

constexpr double kTiePx = 1;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

double distance_px(const PickPoint& point, const glm::dvec2& mouse) {
  return point.at ? glm::distance(*point.at, mouse) : kInfinity;
}

}  // namespace

std::optional<std::size_t> nearest_point(std::span<const PickPoint> points, const glm::dvec2& mouse, double reach_px) {
  double min_px = kInfinity;
  for (const PickPoint& point : points) min_px = std::min(min_px, distance_px(point, mouse));
  if (!(min_px <= reach_px)) return std::nullopt;
  std::optional<std::size_t> best;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const bool ties = distance_px(points[i], mouse) <= std::min(min_px + kTiePx, reach_px);
    if (ties && (!best || points[i].depth_m < points[*best].depth_m)) best = i;
  }
  return best;
}

std::optional<PlaceOnLine> nearest_place(std::span<const std::optional<glm::dvec2>> line, const glm::dvec2& mouse,
                                         double reach_px) {
  std::optional<PlaceOnLine> best;
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    if (!line[i] || !line[i + 1]) continue;
    const glm::dvec2 along = *line[i + 1] - *line[i];
    const double length_2 = glm::dot(along, along);
    const double share = length_2 > 0 ? std::clamp(glm::dot(mouse - *line[i], along) / length_2, 0.0, 1.0) : 0;
    const glm::dvec2 at = *line[i] + along * share;
    const double off_px = glm::distance(at, mouse);
    if (off_px <= (best ? best->distance_px : reach_px) && !(best && off_px == best->distance_px))
      best = PlaceOnLine{.segment = i, .share = share, .at = at, .distance_px = off_px};
  }
  return best;
}

double share_in_world(double share_on_screen, double first_depth_m, double last_depth_m) {
  const double near_part = share_on_screen * first_depth_m;
  const double both = near_part + (1 - share_on_screen) * last_depth_m;
  return both > 0 ? near_part / both : share_on_screen;
}

}  // namespace sigs::editor
