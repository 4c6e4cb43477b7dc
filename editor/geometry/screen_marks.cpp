// SPDX-License-Identifier: MIT
#include "editor/geometry/screen_marks.h"

#include <algorithm>
#include <limits>

namespace sigs::editor {
namespace {

constexpr double kTiePx = 1;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

double distance_px(const PickPoint& point, const glm::dvec2& mouse) {
  return point.at ? glm::distance(*point.at, mouse) : kInfinity;
}

bool overlap(const ScreenRect& a, const ScreenRect& b) {
  return a.low.x < b.high.x && b.low.x < a.high.x && a.low.y < b.high.y && b.low.y < a.high.y;
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
    const auto [share, at] = nearest_on_segment(mouse, *line[i], *line[i + 1]);
    const double off_px = glm::distance(at, mouse);
    if (off_px <= (best ? best->distance_px : reach_px) && !(best && off_px == best->distance_px))
      best = PlaceOnLine{.segment = i, .share = share, .at = at, .distance_px = off_px};
  }
  return best;
}

std::optional<ScreenRect> LabelPlacer::place(std::span<const ScreenRect> candidates, bool in_any_case) {
  const auto is_free = [&](const ScreenRect& candidate) {
    return std::ranges::none_of(taken_, [&](const ScreenRect& other) { return overlap(candidate, other); });
  };
  auto chosen = std::ranges::find_if(candidates, is_free);
  if (chosen == candidates.end() && (!in_any_case || candidates.empty())) return std::nullopt;
  if (chosen == candidates.end()) chosen = candidates.begin();
  keep_free({chosen->low - margin_px_, chosen->high + margin_px_});
  return *chosen;
}

double share_in_world(double share_on_screen, double first_depth_m, double last_depth_m) {
  const double near_part = share_on_screen * first_depth_m;
  const double both = near_part + (1 - share_on_screen) * last_depth_m;
  return both > 0 ? near_part / both : share_on_screen;
}

}  // namespace sigs::editor
