// SPDX-License-Identifier: MIT
#include "editor/geometry/picture_view.h"

#include <algorithm>
#include <cmath>

namespace sigs::editor {
namespace {

constexpr double kSnapShare = 0.03;  // how close to a whole zoom counts as meant

bool is_finite(const glm::dvec2& v) {
  return std::isfinite(v.x) && std::isfinite(v.y);
}

bool has_size(const glm::dvec2& size) {
  return is_finite(size) && size.x > 0 && size.y > 0;
}

// A whole number of screen pixels a picture pixel, or of picture pixels a screen pixel.
double whole_zoom(double zoom) {
  return zoom >= 1 ? std::round(zoom) : 1 / std::round(1 / zoom);
}

// Only a whole zoom that lies ahead draws the zoom to itself: slow steps of a touch pad get away from one.
double snapped_zoom(double before, double zoom) {
  const double whole = whole_zoom(zoom);
  const bool is_close = std::abs(whole - zoom) <= kSnapShare * zoom;
  const bool is_ahead = zoom > before ? whole > before : whole < before;
  return is_close && is_ahead ? whole : zoom;
}

glm::dvec2 exact_origin(double zoom, const glm::dvec2& origin) {
  return zoom >= 1 ? glm::round(origin) : origin;
}

// One axis of panning: where a picture of a length on the screen may begin.
double kept_in_sight(double origin, double length, double low, double high, bool whole) {
  const double showing = std::min(length, high - low) / 4;
  double least = low + showing - length;
  double most = high - showing;
  if (whole && std::ceil(least) <= std::floor(most)) {
    least = std::ceil(least);
    most = std::floor(most);
  }
  return std::clamp(whole ? std::round(origin) : origin, least, most);
}

}  // namespace

glm::dvec2 PictureView::screen_of(const glm::dvec2& picture) const {
  return origin_on_screen + (picture + 0.5) * zoom;
}

glm::dvec2 PictureView::picture_of(const glm::dvec2& screen) const {
  return (screen - origin_on_screen) / zoom - 0.5;
}

PictureView fitted(const glm::dvec2& picture_size, const ScreenRect& rect) {
  const glm::dvec2 middle = (rect.low + rect.high) / 2.0;
  if (!has_size(picture_size) || !has_size(rect.size())) return {1, is_finite(middle) ? middle : glm::dvec2{0, 0}};
  const glm::dvec2 zooms = rect.size() / picture_size;
  const double zoom = std::clamp(std::min(zooms.x, zooms.y), kLeastZoom, kMostZoom);
  return {zoom, exact_origin(zoom, middle - picture_size * zoom / 2.0)};
}

PictureView zoomed(const PictureView& view, double factor, const glm::dvec2& fixed_on_screen) {
  if (!(factor > 0) || factor == 1 || !is_finite(fixed_on_screen)) return view;
  const double wanted = std::clamp(view.zoom * factor, kLeastZoom, kMostZoom);
  const double zoom = wanted == view.zoom ? wanted : snapped_zoom(view.zoom, wanted);
  if (zoom == view.zoom) return view;
  const glm::dvec2 origin = fixed_on_screen + (view.origin_on_screen - fixed_on_screen) * (zoom / view.zoom);
  return {zoom, exact_origin(zoom, origin)};
}

PictureView panned(const PictureView& view, const glm::dvec2& by_px, const glm::dvec2& picture_size,
                   const ScreenRect& rect) {
  if (!is_finite(by_px) || !has_size(picture_size) || !has_size(rect.size())) return view;
  const glm::dvec2 length = picture_size * view.zoom;
  const glm::dvec2 origin = view.origin_on_screen + by_px;
  const bool whole = view.zoom >= 1;
  return {view.zoom,
          {kept_in_sight(origin.x, length.x, rect.low.x, rect.high.x, whole),
           kept_in_sight(origin.y, length.y, rect.low.y, rect.high.y, whole)}};
}

}  // namespace sigs::editor
