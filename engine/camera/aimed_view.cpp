// SPDX-License-Identifier: MIT
#include "camera/aimed_view.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/ensure.h"

namespace sigs {

namespace {

constexpr double kWidestHalfAngle_rad = 50.0 * std::numbers::pi / 180.0;
constexpr double kSmallestExtent_px = 48;  // of a body in its view: coverage is then right to about a percent
constexpr int kMargin_px = 2;              // empty pixels around the body, for the bilinear taps at its edge

using Corners = std::array<glm::dvec3, 8>;

// The shortest turn that brings the axis onto X, so the view is upright where the camera is.
glm::dquat turn_to_axis(const glm::dvec3& axis) {
  const glm::dvec3 x(1, 0, 0);
  if (glm::dot(axis, x) < -0.999999) return {0, 0, 0, 1};  // half a turn about Z
  return glm::normalize(glm::dquat(1 + glm::dot(axis, x), glm::cross(axis, x)));
}

struct Extent {
  glm::dvec2 low{std::numeric_limits<double>::infinity()};
  glm::dvec2 high{-std::numeric_limits<double>::infinity()};
  bool too_wide = false;
};

// The box in tangents of the view's angles.
Extent extent_in(const glm::dquat& view_from_camera, const Corners& corners) {
  Extent extent;
  for (const glm::dvec3& corner : corners) {
    const glm::dvec3 p = view_from_camera * corner;
    if (!(p.x > 0) || std::hypot(p.y, p.z) > std::tan(kWidestHalfAngle_rad) * p.x) {
      extent.too_wide = true;
      return extent;
    }
    const glm::dvec2 tangent(p.y / p.x, p.z / p.x);
    extent.low = glm::min(extent.low, tangent);
    extent.high = glm::max(extent.high, tangent);
  }
  return extent;
}

// As the faces of a cube are.
bool is_wide(const Extent& extent) {
  return extent.high.x - extent.low.x > 1;
}

// Bounds of what the rays of a grid of target's pixels look at near the view's extent, in tangents.
Extent seen_near(const Extent& near, const Camera& camera, const glm::dquat& view_from_camera, const cv::Rect& target,
                 int steps) {
  const glm::dvec2 half_span = 0.5 * (near.high - near.low);
  Extent seen;
  for (int j = 0; j <= steps; ++j)
    for (int i = 0; i <= steps; ++i) {
      const glm::dvec2 share = glm::dvec2(i, j) / double(steps);
      const glm::dvec2 pixel = glm::dvec2(target.x, target.y) - 0.5 + share * glm::dvec2(target.width, target.height);
      const std::optional<glm::dvec3> ray = camera.lens.ray(pixel);
      const glm::dvec3 p = ray ? view_from_camera * *ray : glm::dvec3(0);
      const glm::dvec2 tangent = p.x > 0 ? glm::dvec2(p.y, p.z) / p.x : glm::dvec2(std::numeric_limits<double>::max());
      if (glm::any(glm::lessThan(tangent, near.low - half_span)) ||
          glm::any(glm::greaterThan(tangent, near.high + half_span)))
        continue;
      seen.low = glm::min(seen.low, tangent);
      seen.high = glm::max(seen.high, tangent);
    }
  return seen;
}

// The part of a view that the pixels of target look at; none where a wide view is looked at by none of them. Three
// steps of the grid are left as a margin: tangents grow up to 2.4 times as fast at 50 degrees as at the axis.
std::optional<Extent> cut_to(const Extent& whole, const Camera& camera, const glm::dquat& view_from_camera,
                             const cv::Rect& target) {
  constexpr int kSteps = 16;
  const Extent seen = seen_near(whole, camera, view_from_camera, target, kSteps);
  if (seen.low.x > seen.high.x) return is_wide(whole) ? std::nullopt : std::optional<Extent>(whole);
  const double px_per_rad = camera.lens.pixels_per_radian(glm::conjugate(view_from_camera) * glm::dvec3(1, 0, 0));
  if (px_per_rad == 0) return whole;
  const double margin = 3.0 * std::max(target.width, target.height) / kSteps / px_per_rad;
  const Extent cut{.low = glm::max(whole.low, seen.low - margin), .high = glm::min(whole.high, seen.high + margin)};
  if (cut.low.x >= cut.high.x || cut.low.y >= cut.high.y) return std::nullopt;
  return cut;
}

// Focal length with which the view is nowhere coarser than the picture, by a grid over the view. A pinhole view has
// sqrt(1 + tangent^2) times its focal length, or more, in pixels a radian; only wide views count on that, narrow ones
// take it as a reserve.
double finest_focal_px(const Camera& camera, const glm::dquat& camera_from_view, const Extent& extent) {
  constexpr int kSteps = 4;
  double finest = 0;
  for (int j = 0; j <= kSteps; ++j)
    for (int i = 0; i <= kSteps; ++i) {
      const glm::dvec2 share = glm::dvec2(i, j) / double(kSteps);
      const glm::dvec2 tangent = extent.low + share * (extent.high - extent.low);
      const glm::dvec3 direction = camera_from_view * glm::dvec3(1, tangent.x, tangent.y);
      const double stretch = is_wide(extent) ? std::sqrt(1 + glm::dot(tangent, tangent)) : 1.0;
      finest = std::max(finest, camera.lens.pixels_per_radian(direction) / stretch);
    }
  return finest;
}

//   body  the whole body's extent, by which the smallest resolution is set
VirtualView view_of(const glm::dquat& view_from_camera, const Extent& extent, const Extent& body,
                    double wanted_focal_px, int max_size_px) {
  const glm::dvec2 span = extent.high - extent.low;
  const glm::dvec2 body_span = body.high - body.low;
  const double widest = std::max({span.x, span.y, 1e-9});  // a point has no extent
  const double widest_of_body = std::max({body_span.x, body_span.y, 1e-9});
  double focal_px = std::max(wanted_focal_px, kSmallestExtent_px / widest_of_body);
  focal_px = std::min(focal_px, (max_size_px - 2 * kMargin_px - 2) / widest);
  const glm::dvec2 first = glm::floor(extent.low * focal_px) - double(kMargin_px);
  const glm::dvec2 last = glm::ceil(extent.high * focal_px) + double(kMargin_px);
  return {.view_from_camera = {view_from_camera, {0, 0, 0}},
          .focal_px = focal_px,
          .center_px = -first,
          .size_px = {static_cast<int>(last.x - first.x) + 1, static_cast<int>(last.y - first.y) + 1}};
}

// The view that shows extent, or what target asks of it; none where the lens sees nothing of it.
std::optional<VirtualView> cut_view(const Camera& camera, const glm::dquat& turn, const Extent& extent,
                                    const std::optional<cv::Rect>& target, double supersampling, int max_size_px) {
  const std::optional<Extent> asked = target ? cut_to(extent, camera, turn, *target) : extent;
  if (!asked) return std::nullopt;
  const double finest = finest_focal_px(camera, glm::conjugate(turn), *asked);
  if (finest == 0) return std::nullopt;
  return view_of(turn, *asked, extent, finest * supersampling, max_size_px);
}

// The turns to the faces of a cube around the camera.
std::vector<glm::dquat> cube_turns() {
  std::vector<glm::dquat> turns;
  for (const glm::dvec3& axis : {glm::dvec3{1, 0, 0}, glm::dvec3{0, 1, 0}, glm::dvec3{0, 0, 1}, glm::dvec3{-1, 0, 0},
                                 glm::dvec3{0, -1, 0}, glm::dvec3{0, 0, -1}})
    turns.push_back(turn_to_axis(axis));
  return turns;
}

}  // namespace

std::vector<VirtualView> aimed_views(const Camera& camera, const Corners& corners_in_camera,
                                     const std::optional<cv::Rect>& target, double supersampling, int max_size_px) {
  ENSURE(supersampling >= 1 && max_size_px >= 64);
  glm::dvec3 middle(0);
  for (const glm::dvec3& corner : corners_in_camera) middle += corner / 8.0;
  const double distance_m = glm::length(middle);
  std::vector<glm::dquat> turns{turn_to_axis(distance_m > 0 ? middle / distance_m : glm::dvec3(1, 0, 0))};
  Extent extent = extent_in(turns.front(), corners_in_camera);
  if (extent.too_wide) {
    // A little wider than 90 degrees, so that taps at an edge find colour.
    extent = {.low = glm::dvec2(-1.02), .high = glm::dvec2(1.02)};
    turns = cube_turns();
  }
  std::vector<VirtualView> views;
  for (const glm::dquat& turn : turns)
    if (const auto view = cut_view(camera, turn, extent, target, supersampling, max_size_px)) views.push_back(*view);
  return views;
}

}  // namespace sigs
