// SPDX-License-Identifier: MIT
#include "editor/geometry/image_view.h"

#include <algorithm>
#include <cmath>

#include "base/ensure.h"

namespace sigs::editor {

namespace {

constexpr double kSnapShare = 0.03;  // how close to a whole zoom counts as meant

bool has_size(const glm::dvec2& size) {
  return is_finite(size) && size.x > 0 && size.y > 0;
}

// Only a whole zoom that lies ahead draws the zoom to itself: slow steps of a touch pad get away from one.
double snapped_zoom(double before, double zoom) {
  // A whole number of screen pixels an image pixel, or of image pixels a screen pixel.
  const double whole = zoom >= 1 ? std::round(zoom) : 1 / std::round(1 / zoom);
  const bool is_close = std::abs(whole - zoom) <= kSnapShare * zoom;
  const bool is_ahead = zoom > before ? whole > before : whole < before;
  return is_close && is_ahead ? whole : zoom;
}

glm::dvec2 exact_origin(double zoom, const glm::dvec2& origin) {
  return zoom >= 1 ? glm::round(origin) : origin;
}

// One axis of panning: where an image of a length on the screen may begin.
double kept_in_sight(double origin, double length, double low, double high, bool whole) {
  const double showing = std::min(length, high - low) / 4;
  double minimum = low + showing - length;
  double maximum = high - showing;
  if (whole && std::ceil(minimum) <= std::floor(maximum)) {
    minimum = std::ceil(minimum);
    maximum = std::floor(maximum);
  }
  return std::clamp(whole ? std::round(origin) : origin, minimum, maximum);
}

constexpr double kTiePx = 1;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

double distance_px(const PickPoint& point, const glm::dvec2& mouse) {
  return point.at ? glm::distance(*point.at, mouse) : kInfinity;
}

bool overlap(const ScreenRect& a, const ScreenRect& b) {
  return a.low.x < b.high.x && b.low.x < a.high.x && a.low.y < b.high.y && b.low.y < a.high.y;
}

}  // namespace

bool is_finite(const glm::dvec2& p) {
  return std::isfinite(p.x) && std::isfinite(p.y);
}

bool is_finite(const glm::dvec3& p) {
  return is_finite(glm::dvec2(p)) && std::isfinite(p.z);
}

SegmentPoint nearest_on_segment(const glm::dvec2& p, const glm::dvec2& a, const glm::dvec2& b) {
  const glm::dvec2 along = b - a;
  const double length_2 = glm::dot(along, along);
  const double share = length_2 > 0 ? std::clamp(glm::dot(p - a, along) / length_2, 0.0, 1.0) : 0;
  return {share, a + along * share};
}

double distance_to_segment(const glm::dvec2& p, const glm::dvec2& a, const glm::dvec2& b) {
  return glm::distance(p, nearest_on_segment(p, a, b).at);
}

glm::dvec2 ImageView::screen_of(const glm::dvec2& image) const {
  return origin_on_screen + (image + 0.5) * zoom;
}

glm::dvec2 ImageView::image_of(const glm::dvec2& screen) const {
  return (screen - origin_on_screen) / zoom - 0.5;
}

ImageView fitted(const glm::dvec2& image_size, const ScreenRect& rect) {
  const glm::dvec2 middle = (rect.low + rect.high) / 2.0;
  if (!has_size(image_size) || !has_size(rect.size())) return {1, is_finite(middle) ? middle : glm::dvec2{0, 0}};
  const glm::dvec2 zooms = rect.size() / image_size;
  const double zoom = std::clamp(std::min(zooms.x, zooms.y), kMinZoom, kMaxZoom);
  return {zoom, exact_origin(zoom, middle - image_size * zoom / 2.0)};
}

ImageView zoomed(const ImageView& view, double factor, const glm::dvec2& fixed_on_screen) {
  if (!(factor > 0) || factor == 1 || !is_finite(fixed_on_screen)) return view;
  const double wanted = std::clamp(view.zoom * factor, kMinZoom, kMaxZoom);
  const double zoom = wanted == view.zoom ? wanted : snapped_zoom(view.zoom, wanted);
  if (zoom == view.zoom) return view;
  const glm::dvec2 origin = fixed_on_screen + (view.origin_on_screen - fixed_on_screen) * (zoom / view.zoom);
  return {zoom, exact_origin(zoom, origin)};
}

ImageView panned(const ImageView& view, const glm::dvec2& by_px, const glm::dvec2& image_size, const ScreenRect& rect) {
  if (!is_finite(by_px) || !has_size(image_size) || !has_size(rect.size())) return view;
  const glm::dvec2 length = image_size * view.zoom;
  const glm::dvec2 origin = view.origin_on_screen + by_px;
  const bool whole = view.zoom >= 1;
  return {view.zoom,
          {kept_in_sight(origin.x, length.x, rect.low.x, rect.high.x, whole),
           kept_in_sight(origin.y, length.y, rect.low.y, rect.high.y, whole)}};
}

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
