// SPDX-License-Identifier: MIT
#include "editor/geometry/plane_drag.h"

#include <algorithm>
#include <cmath>

namespace sigs::editor {

namespace {

constexpr double kMinSlope = 0.19;  // sine of 11 degrees
constexpr double kLongest_m = 1e8;

double kept(double along_m) {
  return std::isfinite(along_m) ? std::clamp(along_m, -kLongest_m, kLongest_m) : 0;
}

// Of the axis through the start: where it passes nearest to the ray.
double along_axis_m(const glm::dvec3& start_m, const glm::dvec3& axis, const Ray& ray) {
  const glm::dvec3 to_ray = ray.origin_m - start_m;
  const double cosine = glm::dot(axis, ray.direction);
  return (glm::dot(to_ray, axis) - glm::dot(to_ray, ray.direction) * cosine) / (1 - cosine * cosine);
}

double seen_length(const glm::dvec3& axis, const Ray& ray) {
  return glm::length(glm::cross(axis, ray.direction));
}

}  // namespace

glm::dvec2 dragged_in_plane_m(const PlaneDrag& drag, const glm::dvec2& mouse, const OrbitCamera& camera,
                              const ScreenRect& rect) {
  const auto start = camera.screen_of(drag.start_m, rect);
  const glm::dvec2 by_px = mouse - drag.start_mouse;
  if (!start || !std::isfinite(by_px.x) || !std::isfinite(by_px.y) || by_px == glm::dvec2(0)) return {0, 0};
  const Ray ray = camera.ray_at(*start + by_px, rect);
  const auto& [a, b] = drag.axes;
  const glm::dvec3 normal = glm::cross(a, b);
  const double slope = glm::dot(ray.direction, normal);
  if (std::abs(slope) < kMinSlope) {
    const bool is_first = seen_length(a, ray) >= seen_length(b, ray);
    const double along_m = kept(along_axis_m(drag.start_m, is_first ? a : b, ray));
    return is_first ? glm::dvec2(along_m, 0) : glm::dvec2(0, along_m);
  }
  const double ahead_m = glm::dot(drag.start_m - ray.origin_m, normal) / slope;
  if (camera.projection == Projection::perspective && !(ahead_m > 0)) return {0, 0};
  const glm::dvec3 by_m = ray.origin_m + ray.direction * ahead_m - drag.start_m;
  return {kept(glm::dot(by_m, a)), kept(glm::dot(by_m, b))};
}

}  // namespace sigs::editor
