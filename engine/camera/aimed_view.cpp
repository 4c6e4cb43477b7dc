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

// The finest resolution that the picture has on a grid over the view, as focal length of the view: a pinhole picture
// has focal * (1 + tan^2) pixels a radian at most, so the view needs no more than the lens' figure at its axis and
// edges.
double finest_focal_px(const Camera& camera, const glm::dquat& camera_from_view, const Extent& extent) {
  constexpr int kSteps = 4;
  double finest = 0;
  for (int j = 0; j <= kSteps; ++j)
    for (int i = 0; i <= kSteps; ++i) {
      const glm::dvec2 share = glm::dvec2(i, j) / double(kSteps);
      const glm::dvec2 tangent = extent.low + share * (extent.high - extent.low);
      const glm::dvec3 direction = camera_from_view * glm::dvec3(1, tangent.x, tangent.y);
      finest = std::max(finest, camera.lens.pixels_per_radian(direction));
    }
  return finest;
}

VirtualView view_of(const glm::dquat& view_from_camera, const Extent& extent, double wanted_focal_px, int max_size_px) {
  const glm::dvec2 span = extent.high - extent.low;
  const double widest = std::max({span.x, span.y, 1e-9});  // a point has no extent
  double focal_px = std::max(wanted_focal_px, kSmallestExtent_px / widest);
  focal_px = std::min(focal_px, (max_size_px - 2 * kMargin_px - 2) / widest);
  const glm::dvec2 first = glm::floor(extent.low * focal_px) - double(kMargin_px);
  const glm::dvec2 last = glm::ceil(extent.high * focal_px) + double(kMargin_px);
  return {.view_from_camera = {view_from_camera, {0, 0, 0}},
          .focal_px = focal_px,
          .center_px = -first,
          .size_px = {static_cast<int>(last.x - first.x) + 1, static_cast<int>(last.y - first.y) + 1}};
}

// Faces of a cube around the camera, a little wider than 90 degrees so that taps at an edge find colour.
std::vector<VirtualView> cube_views(const Camera& camera, double supersampling, int max_size_px) {
  const double half = 1.02;
  const Extent extent{.low = glm::dvec2(-half), .high = glm::dvec2(half)};
  const std::array<glm::dvec3, 6> axes{glm::dvec3{1, 0, 0},  {0, 1, 0},  {0, 0, 1},
                                       glm::dvec3{-1, 0, 0}, {0, -1, 0}, {0, 0, -1}};
  std::vector<VirtualView> views;
  for (const glm::dvec3& axis : axes) {
    const glm::dquat turn = turn_to_axis(axis);
    const double finest = finest_focal_px(camera, glm::conjugate(turn), extent);
    if (finest > 0) views.push_back(view_of(turn, extent, finest * supersampling, max_size_px));
  }
  return views;
}

}  // namespace

std::vector<VirtualView> aimed_views(const Camera& camera, const Corners& corners_in_camera, double supersampling,
                                     int max_size_px) {
  ENSURE(supersampling >= 1 && max_size_px >= 64);
  glm::dvec3 middle(0);
  for (const glm::dvec3& corner : corners_in_camera) middle += corner / 8.0;
  const double distance_m = glm::length(middle);
  if (distance_m == 0) return cube_views(camera, supersampling, max_size_px);
  const glm::dquat turn = turn_to_axis(middle / distance_m);
  const Extent extent = extent_in(turn, corners_in_camera);
  if (extent.too_wide) return cube_views(camera, supersampling, max_size_px);
  const double finest = finest_focal_px(camera, glm::conjugate(turn), extent);
  if (finest == 0) return {};
  return {view_of(turn, extent, finest * supersampling, max_size_px)};
}

}  // namespace sigs
