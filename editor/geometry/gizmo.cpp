// SPDX-License-Identifier: MIT
#include "editor/geometry/gizmo.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "editor/geometry/rulers.h"

namespace sigs::editor {

namespace {

constexpr double kMaxCoordinateM = 1e8;
constexpr double kMinArrow = 0.12;   // of its length: what is shorter on the screen points at the eye
constexpr double kPlaneFrom = 0.28;  // where the plane handles lie between the arrows, of their length
constexpr double kPlaneTo = 0.55;
constexpr double kEdgeOnSine = 0.1;     // between plane and line of sight: a handle seen flatter is left out
constexpr double kNoAnswerSine = 0.01;  // a drag needs less, but not nothing
constexpr double kStepPx = 8;

constexpr std::array<glm::dvec3, 3> kAxes{glm::dvec3{1, 0, 0}, glm::dvec3{0, 1, 0}, glm::dvec3{0, 0, 1}};

// The axes that span the plane handles xy, yz, zx, and what is left.
struct PlaneAxes {
  int first;
  int second;
  int normal;
};
constexpr std::array<PlaneAxes, 3> kPlanes{PlaneAxes{0, 1, 2}, PlaneAxes{1, 2, 0}, PlaneAxes{2, 0, 1}};

constexpr std::array<GizmoPart, 3> kAxisParts{GizmoPart::x, GizmoPart::y, GizmoPart::z};
constexpr std::array<GizmoPart, 3> kPlaneParts{GizmoPart::xy, GizmoPart::yz, GizmoPart::zx};

// From the eye to a point, unit.
glm::dvec3 sight_to(const OrbitCamera& camera, const glm::dvec3& p_m) {
  return camera.projection == Projection::parallel ? camera.forward() : glm::normalize(p_m - camera.eye_m());
}

std::optional<std::array<glm::dvec2, 4>> quad_of(const PlaneAxes& plane, const glm::dvec3& center_m, double length_m,
                                                 const OrbitCamera& camera, const ScreenRect& rect) {
  if (std::abs(sight_to(camera, center_m)[plane.normal]) < kEdgeOnSine) return std::nullopt;
  constexpr std::array<glm::dvec2, 4> kCorners{glm::dvec2{kPlaneFrom, kPlaneFrom}, glm::dvec2{kPlaneTo, kPlaneFrom},
                                               glm::dvec2{kPlaneTo, kPlaneTo}, glm::dvec2{kPlaneFrom, kPlaneTo}};
  std::array<glm::dvec2, 4> quad{};
  for (std::size_t i = 0; i < quad.size(); ++i) {
    const glm::dvec3 corner_m =
        center_m + length_m * (kAxes[plane.first] * kCorners[i].x + kAxes[plane.second] * kCorners[i].y);
    const auto corner = camera.screen_of(corner_m, rect);
    if (!corner) return std::nullopt;
    quad[i] = *corner;
  }
  return quad;
}

double distance_to_quad(const glm::dvec2& p, const std::array<glm::dvec2, 4>& quad) {
  double nearest = std::numeric_limits<double>::infinity();
  int left_of = 0;
  for (std::size_t i = 0; i < quad.size(); ++i) {
    const glm::dvec2& a = quad[i];
    const glm::dvec2& b = quad[(i + 1) % quad.size()];
    nearest = std::min(nearest, distance_to_segment(p, a, b));
    left_of += (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x) > 0 ? 1 : 0;
  }
  const bool inside = left_of == 0 || left_of == 4;
  return inside ? 0 : nearest;
}

struct Nearest {
  GizmoPart part = GizmoPart::none;
  double distance_px = std::numeric_limits<double>::infinity();
  void offer(GizmoPart other, double other_px) {
    if (other_px < distance_px) *this = {other, other_px};
  }
};

// A drag as all parts see it: where the point stands before the eye, and where it should be seen.
struct Pull {
  glm::dvec3 start_m;
  glm::dvec2 by_px;   // on the screen
  glm::dvec2 wanted;  // place on the screen
};

// Along an axis a, from the point p (both in the eye's axes: right, up, ahead), the screen place s metres on is
//   F (p.xy + s a.xy) / (p.z + s a.z).
// It runs along a straight line, and has gone d pixels along it where s = d p.z^2 / (F |w| - d p.z a.z) with
// w = a.xy p.z - p.xy a.z. At the axis' vanishing point the denominator is 0.
std::optional<double> metres_along(const glm::dvec3& axis, const Pull& pull, const OrbitCamera& camera,
                                   const ScreenRect& rect) {
  const bool parallel = camera.projection == Projection::parallel;
  const glm::dvec3 from_eye = pull.start_m - camera.eye_m();
  const double depth_m = parallel ? camera.distance_m : glm::dot(from_eye, camera.forward());
  const double axis_ahead = parallel ? 0 : glm::dot(axis, camera.forward());
  const double focal_px = camera.pixels_per_metre(pull.start_m, rect) * depth_m;
  const glm::dvec2 axis_aside{glm::dot(axis, camera.right()), -glm::dot(axis, camera.up())};
  const glm::dvec2 aside_m{glm::dot(from_eye, camera.right()), -glm::dot(from_eye, camera.up())};
  const glm::dvec2 w = axis_aside * depth_m - (parallel ? glm::dvec2{0, 0} : aside_m) * axis_ahead;
  const double length = glm::length(w);
  if (glm::length(glm::cross(sight_to(camera, pull.start_m), axis)) < kNoAnswerSine || !(length > 0))
    return std::nullopt;
  const double along_px = glm::dot(pull.by_px, w / length);
  const double denominator = focal_px * length - along_px * depth_m * axis_ahead;
  if (!(denominator > 0)) return std::nullopt;
  return along_px * depth_m * depth_m / denominator;
}

std::optional<glm::dvec3> in_plane(const PlaneAxes& plane, const Pull& pull, const OrbitCamera& camera,
                                   const ScreenRect& rect) {
  if (std::abs(sight_to(camera, pull.start_m)[plane.normal]) < kNoAnswerSine) return std::nullopt;
  const Ray ray = camera.ray_at(pull.wanted, rect);
  const double along_m = (pull.start_m - ray.origin_m)[plane.normal] / ray.direction[plane.normal];
  const bool ahead = camera.projection == Projection::parallel || along_m > 0;
  if (!ahead || !std::isfinite(along_m)) return std::nullopt;
  glm::dvec3 result = ray.origin_m + ray.direction * along_m;
  result[plane.normal] = pull.start_m[plane.normal];
  return result;
}

template <std::size_t N>
std::optional<int> index_in(const std::array<GizmoPart, N>& parts, GizmoPart part) {
  const auto found = std::ranges::find(parts, part);
  if (found == parts.end()) return std::nullopt;
  return static_cast<int>(found - parts.begin());
}

// Which coordinates a part can change.
std::array<bool, 3> moved_by(GizmoPart part, const OrbitCamera& camera) {
  if (const auto axis = index_in(kAxisParts, part)) return {*axis == 0, *axis == 1, *axis == 2};
  std::array<bool, 3> moves{true, true, true};
  if (const auto plane = index_in(kPlaneParts, part)) {
    moves[kPlanes[*plane].normal] = false;
  } else {
    const glm::dvec3 forward = camera.forward();
    for (int i = 0; i < 3; ++i) moves[i] = std::abs(forward[i]) < 1 - 1e-12;  // seen from above, heights stay
  }
  return moves;
}

std::optional<glm::dvec3> pulled(GizmoPart part, const Pull& pull, const OrbitCamera& camera, const ScreenRect& rect) {
  if (const auto axis = index_in(kAxisParts, part)) {
    const std::optional<double> by_m = metres_along(kAxes[*axis], pull, camera, rect);
    return by_m ? std::optional(pull.start_m + kAxes[*axis] * *by_m) : std::nullopt;
  }
  if (const auto plane = index_in(kPlaneParts, part)) return in_plane(kPlanes[*plane], pull, camera, rect);
  if (part != GizmoPart::screen) return std::nullopt;
  const double px_per_m = camera.pixels_per_metre(pull.start_m, rect);
  return pull.start_m + (camera.right() * pull.by_px.x - camera.up() * pull.by_px.y) / px_per_m;
}

constexpr double kMinSlope = 0.19;  // sine of 11 degrees

double kept(double along_m) {
  return std::isfinite(along_m) ? std::clamp(along_m, -kMaxCoordinateM, kMaxCoordinateM) : 0;
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

std::optional<GizmoShape> gizmo_shape(const Gizmo& gizmo, const OrbitCamera& camera, const ScreenRect& rect) {
  const auto center = camera.screen_of(gizmo.center_m, rect);
  if (!center) return std::nullopt;
  GizmoShape shape{.center = *center};
  const double length_m = gizmo.arrow_px / camera.pixels_per_metre(gizmo.center_m, rect);
  for (std::size_t i = 0; i < 3; ++i) {
    const auto tip = camera.screen_of(gizmo.center_m + kAxes[i] * length_m, rect);
    if (tip && glm::distance(*tip, *center) >= kMinArrow * gizmo.arrow_px) shape.tips[i] = tip;
    shape.planes[i] = quad_of(kPlanes[i], gizmo.center_m, length_m, camera, rect);
  }
  return shape;
}

GizmoPart part_at(const GizmoShape& shape, const glm::dvec2& mouse, double reach_px) {
  if (!is_finite(mouse)) return GizmoPart::none;
  if (glm::distance(mouse, shape.center) <= reach_px) return GizmoPart::screen;
  Nearest plane;
  Nearest axis;
  for (std::size_t i = 0; i < 3; ++i) {
    if (shape.planes[i]) plane.offer(kPlaneParts[i], distance_to_quad(mouse, *shape.planes[i]));
    if (shape.tips[i]) axis.offer(kAxisParts[i], distance_to_segment(mouse, shape.center, *shape.tips[i]));
  }
  if (plane.distance_px <= reach_px) return plane.part;
  return axis.distance_px <= reach_px ? axis.part : GizmoPart::none;
}

glm::dvec3 dragged(const GizmoDrag& drag, const glm::dvec2& mouse, const OrbitCamera& camera, const ScreenRect& rect,
                   double snap_m) {
  const glm::dvec2 by_px = mouse - drag.start_mouse;
  const auto start = camera.screen_of(drag.start_m, rect);
  if (!start || !is_finite(by_px) || by_px == glm::dvec2{0, 0}) return kept_in_space(drag.start_m, kMaxCoordinateM);
  const auto moved = pulled(drag.part, {drag.start_m, by_px, *start + by_px}, camera, rect);
  if (!moved) return kept_in_space(drag.start_m, kMaxCoordinateM);
  glm::dvec3 result = kept_in_space(*moved, kMaxCoordinateM);
  const std::array<bool, 3> moves = moved_by(drag.part, camera);
  for (int i = 0; i < 3; ++i) {
    if (!moves[i]) result[i] = drag.start_m[i];
    if (moves[i] && snap_m > 0 && std::isfinite(snap_m)) result[i] = rounded_to(result[i], snap_m);
  }
  return kept_in_space(result, kMaxCoordinateM);
}

double snap_step_m(const OrbitCamera& camera, const glm::dvec3& at_m, const ScreenRect& rect) {
  return round_step(kStepPx / camera.pixels_per_metre(at_m, rect));
}

glm::dvec2 dragged_in_plane_m(const PlaneDrag& drag, const glm::dvec2& mouse, const OrbitCamera& camera,
                              const ScreenRect& rect) {
  const auto start = camera.screen_of(drag.start_m, rect);
  const glm::dvec2 by_px = mouse - drag.start_mouse;
  if (!start || !is_finite(by_px) || by_px == glm::dvec2(0)) return {0, 0};
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
