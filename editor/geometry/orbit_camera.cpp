// SPDX-License-Identifier: MIT
#include "editor/geometry/orbit_camera.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace sigs::editor {
namespace {

constexpr double kNearShare = 1e-3;      // of the distance: what lies nearer to the eye is not is_visible
constexpr double kTurnRadPerPx = 0.005;  // a drag across 630 pixels turns half round
constexpr double kFramedShare = 0.85;    // of the screen, for what is to be in sight
constexpr double kMinDistanceM = 0.1;
constexpr double kMaxDistanceM = 1e9;
constexpr double kFarOutPx = 10000;  // floats still hold a thousandth of a pixel there

glm::dvec2 middle(const ScreenRect& rect) {
  return (rect.low + rect.high) / 2.0;
}

// Pixels from the middle of the screen to where a slope of 1 leads.
double focal_px(const OrbitCamera& camera, const ScreenRect& rect) {
  const glm::dvec2 size = rect.size();
  return std::max(1.0, std::min(size.x, size.y)) / 2 / std::tan(camera.field_rad / 2);
}

// To the right, up and ahead of the eye, metres.
glm::dvec3 in_view(const OrbitCamera& camera, const glm::dvec3& p_in_world) {
  const glm::dvec3 from_target = p_in_world - camera.target_m;
  return {glm::dot(from_target, camera.right()), glm::dot(from_target, camera.up()),
          glm::dot(from_target, camera.forward()) + camera.distance_m};
}

double near_m(const OrbitCamera& camera) {
  return camera.distance_m * kNearShare;
}

double scale_at(const OrbitCamera& camera, double depth_m, const ScreenRect& rect) {
  const bool parallel = camera.projection == Projection::parallel;
  return focal_px(camera, rect) / (parallel ? camera.distance_m : std::max(depth_m, near_m(camera)));
}

glm::dvec2 projected(const OrbitCamera& camera, const glm::dvec3& p_in_view, const ScreenRect& rect) {
  return middle(rect) + glm::dvec2{p_in_view.x, -p_in_view.y} * scale_at(camera, p_in_view.z, rect);
}

bool is_before_eye(const OrbitCamera& camera, double depth_m) {
  return camera.projection == Projection::parallel || depth_m >= near_m(camera);
}

// Where the middle of the screen, at the target's depth, has to be looked for when a point there is to stay.
glm::dvec3 offset_at_target(const OrbitCamera& camera, const glm::dvec2& by_px, const ScreenRect& rect) {
  const double metres_per_px = camera.distance_m / focal_px(camera, rect);
  return (camera.right() * by_px.x - camera.up() * by_px.y) * metres_per_px;
}

// How far to stand off the middle of a box so that the point, given from there, is within the framed slopes.
double distance_for(const glm::dvec3& from_middle, const glm::dvec2& slopes, Projection projection) {
  const double beside = std::max(std::abs(from_middle.x) / slopes.x, std::abs(from_middle.y) / slopes.y);
  if (projection == Projection::parallel) return beside;
  return std::max(beside - from_middle.z, 1.05 * -from_middle.z);
}

}  // namespace

glm::dvec3 OrbitCamera::eye_m() const {
  return target_m - forward() * distance_m;
}

glm::dvec3 OrbitCamera::forward() const {
  const double level = std::cos(elevation_rad);
  return {level * std::cos(bearing_rad), level * std::sin(bearing_rad), std::sin(elevation_rad)};
}

glm::dvec3 OrbitCamera::right() const {
  return {-std::sin(bearing_rad), std::cos(bearing_rad), 0};
}

glm::dvec3 OrbitCamera::up() const {
  const double down = std::sin(elevation_rad);
  return {down * std::cos(bearing_rad), down * std::sin(bearing_rad), -std::cos(elevation_rad)};
}

double OrbitCamera::pixels_per_metre(const glm::dvec3& p_in_world, const ScreenRect& rect) const {
  return scale_at(*this, in_view(*this, p_in_world).z, rect);
}

std::optional<glm::dvec2> OrbitCamera::screen_of(const glm::dvec3& p_in_world, const ScreenRect& rect) const {
  const glm::dvec3 p_in_view = in_view(*this, p_in_world);
  if (!is_finite(p_in_view) || !is_before_eye(*this, p_in_view.z)) return std::nullopt;
  return projected(*this, p_in_view, rect);
}

Ray OrbitCamera::ray_at(const glm::dvec2& screen, const ScreenRect& rect) const {
  const glm::dvec2 from_middle = screen - middle(rect);
  if (projection == Projection::parallel) return {eye_m() + offset_at_target(*this, from_middle, rect), forward()};
  const glm::dvec2 slope = from_middle / focal_px(*this, rect);
  return {eye_m(), glm::normalize(forward() + right() * slope.x - up() * slope.y)};
}

glm::dvec3 kept_in_space(glm::dvec3 p_m, double limit_m) {
  for (int i = 0; i < 3; ++i) p_m[i] = std::isnan(p_m[i]) ? 0 : std::clamp(p_m[i], -limit_m, limit_m);
  return p_m;
}

std::optional<std::array<glm::dvec2, 2>> screen_line(const OrbitCamera& camera, const ScreenRect& rect,
                                                     const glm::dvec3& a_m, const glm::dvec3& b_m) {
  std::array<glm::dvec3, 2> ends{in_view(camera, a_m), in_view(camera, b_m)};
  if (!is_finite(ends[0]) || !is_finite(ends[1])) return std::nullopt;
  const std::array<bool, 2> is_visible{is_before_eye(camera, ends[0].z), is_before_eye(camera, ends[1].z)};
  if (!is_visible[0] && !is_visible[1]) return std::nullopt;
  if (!is_visible[0] || !is_visible[1]) {
    const double share = (near_m(camera) - ends[0].z) / (ends[1].z - ends[0].z);
    glm::dvec3& hidden = is_visible[0] ? ends[1] : ends[0];
    hidden = glm::mix(ends[0], ends[1], share);
    hidden.z = near_m(camera);
  }
  const ScreenRect around{rect.low - kFarOutPx, rect.high + kFarOutPx};
  return line_within({projected(camera, ends[0], rect), projected(camera, ends[1], rect)}, around);
}

// Liang and Barsky 1984.
std::optional<std::array<glm::dvec2, 2>> line_within(const std::array<glm::dvec2, 2>& line, const ScreenRect& box) {
  const glm::dvec2 along = line[1] - line[0];
  double first = 0;
  double last = 1;
  for (int axis = 0; axis < 2; ++axis) {
    if (along[axis] == 0) {
      if (line[0][axis] < box.low[axis] || line[0][axis] > box.high[axis]) return std::nullopt;
      continue;
    }
    const double to_low = (box.low[axis] - line[0][axis]) / along[axis];
    const double to_high = (box.high[axis] - line[0][axis]) / along[axis];
    first = std::max(first, std::min(to_low, to_high));
    last = std::min(last, std::max(to_low, to_high));
  }
  if (!(first <= last)) return std::nullopt;
  return std::array{first > 0 ? line[0] + along * first : line[0], last < 1 ? line[0] + along * last : line[1]};
}

OrbitCamera orbited(const OrbitCamera& camera, const glm::dvec2& by_px) {
  if (!is_finite(by_px)) return camera;
  constexpr double kUpright = std::numbers::pi / 2;
  OrbitCamera result = camera;
  result.bearing_rad = std::remainder(camera.bearing_rad + by_px.x * kTurnRadPerPx, 2 * std::numbers::pi);
  result.elevation_rad = std::clamp(camera.elevation_rad + by_px.y * kTurnRadPerPx, -kUpright, kUpright);
  return result;
}

OrbitCamera panned(const OrbitCamera& camera, const glm::dvec2& by_px, const ScreenRect& rect) {
  if (!is_finite(by_px)) return camera;
  OrbitCamera result = camera;
  result.target_m = kept_in_space(camera.target_m - offset_at_target(camera, by_px, rect), kMaxDistanceM);
  return result;
}

OrbitCamera approached(const OrbitCamera& camera, double factor, const glm::dvec2& at_screen, const ScreenRect& rect) {
  if (!(factor > 0) || !is_finite(at_screen)) return camera;
  OrbitCamera result = camera;
  result.distance_m = std::clamp(camera.distance_m / factor, kMinDistanceM, kMaxDistanceM);
  const glm::dvec3 to_fixed = offset_at_target(camera, at_screen - middle(rect), rect);
  result.target_m =
      kept_in_space(camera.target_m + to_fixed * (1 - result.distance_m / camera.distance_m), kMaxDistanceM);
  return result;
}

OrbitCamera framing(const OrbitCamera& camera, std::span<const glm::dvec3> points_m, const ScreenRect& rect) {
  glm::dvec3 low{std::numeric_limits<double>::infinity()};
  glm::dvec3 high{-low};
  for (const glm::dvec3& point_m : points_m) {
    const glm::dvec3 p_in_view = in_view(camera, point_m);
    if (!is_finite(p_in_view)) continue;
    low = glm::min(low, p_in_view);
    high = glm::max(high, p_in_view);
  }
  if (!(low.x <= high.x)) return camera;
  const glm::dvec3 center = (low + high) / 2.0;
  const glm::dvec3 from_target{center.x, center.y, center.z - camera.distance_m};
  OrbitCamera result = camera;
  result.target_m = kept_in_space(
      camera.target_m + camera.right() * from_target.x + camera.up() * from_target.y + camera.forward() * from_target.z,
      kMaxDistanceM);
  if (low == high) return result;  // a single place says nothing of how near to go
  const glm::dvec2 slopes = kFramedShare * glm::max(rect.size(), 1.0) / 2.0 / focal_px(camera, rect);
  double distance_m = kMinDistanceM;
  for (const glm::dvec3& point_m : points_m) {
    const glm::dvec3 p_in_view = in_view(camera, point_m);
    if (is_finite(p_in_view))
      distance_m = std::max(distance_m, distance_for(p_in_view - center, slopes, camera.projection));
  }
  result.distance_m = std::min(distance_m, kMaxDistanceM);
  return result;
}

LightDirection direction_of(const glm::dvec3& light_m, const glm::dvec3& from_m) {
  const glm::dvec3 to_light = light_m - from_m;
  const double level_m = std::hypot(to_light.x, to_light.y);
  if (level_m == 0 && to_light.z == 0) return {};
  // Straight up and the negative zeros of atan2 count as bearing 0, straight back as +pi.
  const double bearing_rad = level_m > 0 ? std::atan2(to_light.y, to_light.x) : 0;
  return {.bearing_rad = bearing_rad <= -std::numbers::pi ? std::numbers::pi : bearing_rad,
          .elevation_rad = std::atan2(-to_light.z, level_m),
          .distance_m = std::hypot(level_m, to_light.z)};
}

glm::dvec3 position_of(const LightDirection& direction, const glm::dvec3& from_m) {
  const double level = std::cos(direction.elevation_rad);
  const glm::dvec3 to_light{level * std::cos(direction.bearing_rad), level * std::sin(direction.bearing_rad),
                            -std::sin(direction.elevation_rad)};
  return from_m + to_light * direction.distance_m;
}

}  // namespace sigs::editor
