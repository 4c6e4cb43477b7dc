// SPDX-License-Identifier: MIT
#include "camera/virtual_camera.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <span>

#include "base/ensure.h"
#include "base/image.h"
#include "base/pose.h"

namespace sigs {

std::optional<glm::dvec2> VirtualCamera::pixel(const glm::dvec3& p_in_camera) const {
  const glm::dvec3 p_in_view = view_from_camera * p_in_camera;
  if (!(p_in_view.x > 0)) return std::nullopt;
  const glm::dvec2 result = center_px + focal_px * glm::dvec2{p_in_view.y / p_in_view.x, p_in_view.z / p_in_view.x};
  if (!std::isfinite(result.x) || !std::isfinite(result.y)) return std::nullopt;
  return result;
}

namespace {

constexpr double kWidestHalfAngle_rad = 50.0 * std::numbers::pi / 180.0;
constexpr double kSmallestExtent_px = 128;  // of a body in its view: its area is then accurate to about half a percent
constexpr int kMargin_px = 2;               // empty pixels around the body, for bilinear interpolation at its edge

// Up to this extent a body is rendered with this supersampling even if less is asked for. That costs little, and thin
// tips, which 16 samples per pixel can miss, then keep their positions.
constexpr double kFineExtent_px = 192;
constexpr double kFineSupersampling = 8;

constexpr double kMostStretched = 4;  // pixels of a 360 degree image that a view follows: that often as high as wide

using Corners = std::array<glm::dvec3, 8>;

// The shortest rotation that takes the axis to X, so that the view is upright where the camera is.
glm::dquat rotation_to_axis(const glm::dvec3& axis) {
  const glm::dvec3 x(1, 0, 0);
  if (glm::dot(axis, x) < -0.999999) return {0, 0, 0, 1};  // 180 degrees about Z
  return glm::normalize(glm::dquat(1 + glm::dot(axis, x), glm::cross(axis, x)));
}

// A rectangle of a view, in tangents of the angles from its axis: y right, z down.
struct Extent {
  glm::dvec2 low{std::numeric_limits<double>::infinity()};
  glm::dvec2 high{-std::numeric_limits<double>::infinity()};
  bool too_wide = false;
};

// Bounds of the box in the view.
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

// Whether the view is as wide as the face of a cube.
bool is_wide(const Extent& extent) {
  return extent.high.x - extent.low.x > 1;
}

// A direction in the view as tangents; the largest double where it points backwards.
glm::dvec2 tangent_of(const glm::dvec3& p_in_view) {
  return p_in_view.x > 0 ? glm::dvec2(p_in_view.y, p_in_view.z) / p_in_view.x
                         : glm::dvec2(std::numeric_limits<double>::max());
}

bool contains(const Extent& extent, const glm::dvec2& tangent) {
  return glm::all(glm::greaterThanEqual(tangent, extent.low)) && glm::all(glm::lessThanEqual(tangent, extent.high));
}

// The rays of a grid over the target's pixels, from edge to edge; (0, 0, 0) where the lens has none.
struct TargetRays {
  static constexpr int kSteps = 64;
  std::vector<glm::dvec3> rays;  // rows of kSteps + 1
};

TargetRays rays_over(const cv::Rect& target, LensTable& lens) {
  TargetRays grid;
  for (int j = 0; j <= TargetRays::kSteps; ++j) {
    const int y = target.y + static_cast<int>(std::int64_t{target.height} * j / TargetRays::kSteps);
    const std::span<const glm::dvec3> row = lens.corner_rays(target.x, y, target.width + 1);
    for (int i = 0; i <= TargetRays::kSteps; ++i)
      grid.rays.push_back(row[static_cast<std::size_t>(std::int64_t{target.width} * i / TargetRays::kSteps)]);
  }
  return grid;
}

// Whether any pixel can look to within half_angle_rad of a direction: the nearest of the grid's rays may miss it by
// somewhat more than the grid's largest step. A body behind a fisheye has an image round about the image, which
// only this tells from one in it.
bool is_looked_at(const TargetRays& target, const glm::dvec3& direction, double half_angle_rad) {
  using distortion::angle_between;
  constexpr double kReserve = 1.5;
  constexpr std::size_t kAcross = TargetRays::kSteps + 1;
  const std::vector<glm::dvec3>& rays = target.rays;
  const auto has_ray = [&rays](std::size_t n) { return rays[n] != glm::dvec3(0); };
  double nearest_rad = std::numeric_limits<double>::infinity();
  double step_rad = 0;
  for (std::size_t n = 0; n < rays.size(); ++n) {
    if (!has_ray(n)) continue;
    nearest_rad = std::min(nearest_rad, angle_between(rays[n], direction));
    if (n % kAcross != 0 && has_ray(n - 1)) step_rad = std::max(step_rad, angle_between(rays[n], rays[n - 1]));
    if (n >= kAcross && has_ray(n - kAcross)) step_rad = std::max(step_rad, angle_between(rays[n], rays[n - kAcross]));
  }
  // Where the lens' field is so small that it falls between the grid's points, the answer is yes: nothing is known.
  return step_rad == 0 || nearest_rad <= half_angle_rad + kReserve * step_rad;
}

Extent widened(const Extent& extent, double by) {
  return {.low = extent.low - by, .high = extent.high + by};
}

// The largest step between neighbouring points of the grid of which one lies in the extent and both are in front of
// the view. 0 where there is no such pair.
double largest_step(const std::vector<glm::dvec2>& tangents, const Extent& extent) {
  constexpr std::size_t kAcross = TargetRays::kSteps + 1;
  constexpr double kNowhere = std::numeric_limits<double>::max();  // tangent_of of directions that point backwards
  double largest = 0;
  const auto compare = [&](const glm::dvec2& a, const glm::dvec2& b) {
    if (a.x != kNowhere && b.x != kNowhere && (contains(extent, a) || contains(extent, b)))
      largest = std::max(largest, glm::distance(a, b));
  };
  for (std::size_t n = 0; n < tangents.size(); ++n) {
    if (n % kAcross != 0) compare(tangents[n], tangents[n - 1]);
    if (n >= kAcross) compare(tangents[n], tangents[n - kAcross]);
  }
  return largest;
}

// Bounds of the directions that the target's pixels look along within the view's extent and close to it; grown by
// somewhat more than the grid's step there, for the pixels between its points. low > high where there are none.
Extent visible_near(const Extent& whole, const TargetRays& target, const glm::dquat& view_from_camera) {
  constexpr double kReserve = 1.5;
  const glm::dmat3 rotation = glm::mat3_cast(view_from_camera);
  std::vector<glm::dvec2> tangents;
  tangents.reserve(target.rays.size());
  for (const glm::dvec3& ray : target.rays) tangents.push_back(tangent_of(rotation * ray));
  const double span = glm::distance(whole.low, whole.high);
  const double margin = kReserve * std::min(largest_step(tangents, widened(whole, 0.2 * span)), span);
  const Extent near = widened(whole, margin);
  Extent visible;
  for (const glm::dvec2& tangent : tangents) {
    if (!contains(near, tangent)) continue;
    visible.low = glm::min(visible.low, tangent);
    visible.high = glm::max(visible.high, tangent);
  }
  return visible.low.x > visible.high.x ? visible : widened(visible, margin);
}

// The part of a view that the target's pixels look at; none where no pixel looks at a wide view.
std::optional<Extent> cut_to(const Extent& whole, const TargetRays& target, const glm::dquat& view_from_camera) {
  const Extent visible = visible_near(whole, target, view_from_camera);
  if (visible.low.x > visible.high.x) return is_wide(whole) ? std::nullopt : std::optional<Extent>(whole);
  const Extent cut{.low = glm::max(whole.low, visible.low), .high = glm::min(whole.high, visible.high)};
  if (cut.low.x >= cut.high.x || cut.low.y >= cut.high.y) return std::nullopt;
  return cut;
}

// How far the image's pixel moves, at most, when the view's tangent changes by 1; px. 0 where there is no image or,
// given `within`, where the image lies outside it.
double px_per_tangent(LensTable& lens, const glm::dquat& camera_from_view, const glm::dvec2& tangent,
                      const std::optional<cv::Rect>& within) {
  constexpr double kStep = 1e-5;
  const auto pixel = [&](double x, double y) { return lens.pixel(camera_from_view * glm::dvec3(1, x, y)); };
  const std::optional<glm::dvec2> at = pixel(tangent.x, tangent.y);
  if (!at) return 0;
  if (within && (at->x < within->x || at->y < within->y || at->x > within->x + within->width ||
                 at->y > within->y + within->height))
    return 0;
  const std::optional<glm::dvec2> right = pixel(tangent.x + kStep, tangent.y);
  const std::optional<glm::dvec2> below = pixel(tangent.x, tangent.y + kStep);
  if (!right || !below) return 0;
  const Lens& model = lens.camera().lens;
  const glm::dmat2 slopes{model.way(*at, *right) / kStep, model.way(*at, *below) / kStep};
  const double largest = distortion::largest_singular_value(slopes);
  if (!(model.period_px() > 0) || largest == 0) return largest;
  // Towards a pole columns become ever narrower in angle, without showing more.
  return std::min(largest, kMostStretched * std::abs(glm::determinant(slopes)) / largest);
}

// The target, grown by as much as the grid of finest_focal_px could miss.
cv::Rect grown_by_grid(const cv::Rect& target) {
  return grown(target, std::max(target.width, target.height) / 32 + 1);
}

// Focal length with which the view is nowhere coarser than the image, found on a grid over the view.
double finest_focal_px(LensTable& lens, const glm::dquat& camera_from_view, const Extent& extent,
                       const std::optional<cv::Rect>& within) {
  const int steps = within ? 16 : 8;
  double finest = 0;
  for (int j = 0; j <= steps; ++j)
    for (int i = 0; i <= steps; ++i) {
      const glm::dvec2 share = glm::dvec2(i, j) / double(steps);
      const glm::dvec2 tangent = extent.low + share * (extent.high - extent.low);
      finest = std::max(finest, px_per_tangent(lens, camera_from_view, tangent, within));
    }
  return finest;
}

// Smallest focal length with which a body is rendered, whatever supersampling is asked for.
//   body      the whole body's extent
//   focal_px  with which the view is as fine as the image
double min_focal_px(const Extent& body, double focal_px) {
  const glm::dvec2 span = body.high - body.low;
  const double widest = std::max({span.x, span.y, 1e-9});  // not zero, also for a point
  return std::max(kSmallestExtent_px / widest, std::min(kFineSupersampling * focal_px, kFineExtent_px / widest));
}

// Largest focal length with which the view does not exceed max_size_px.
double largest_focal_px(const Extent& extent, int max_size_px) {
  const glm::dvec2 span = extent.high - extent.low;
  return (max_size_px - 2 * kMargin_px - 2) / std::max({span.x, span.y, 1e-9});
}

// The view of an extent, with its margin.
//   phase_px  the principal point up to a whole number of pixels
VirtualCamera view_of(const glm::dquat& view_from_camera, const Extent& extent, double focal_px,
                      const glm::dvec2& phase_px) {
  const glm::dvec2 first = glm::floor(extent.low * focal_px + phase_px) - double(kMargin_px);
  const glm::dvec2 last = glm::ceil(extent.high * focal_px + phase_px) + double(kMargin_px);
  return {.view_from_camera = {view_from_camera, {0, 0, 0}},
          .focal_px = focal_px,
          .center_px = phase_px - first,
          .size_px = {static_cast<int>(last.x - first.x) + 1, static_cast<int>(last.y - first.y) + 1}};
}

// The view of an extent, or of the part that the target samples; none where the lens has no image of it.
std::optional<VirtualCamera> cut_view(LensTable& lens, const glm::dquat& view_from_camera, const Extent& extent,
                                      const std::optional<cv::Rect>& target, const TargetRays& rays,
                                      double supersampling, int max_size_px) {
  const std::optional<Extent> asked = target ? cut_to(extent, rays, view_from_camera) : extent;
  if (!asked) return std::nullopt;
  const glm::dquat camera_from_view = glm::conjugate(view_from_camera);
  // Without the restriction to the target, the grid's points beyond it would ask for a finer view than the target
  // needs, above all with a wide pinhole.
  double finest = target ? finest_focal_px(lens, camera_from_view, *asked, grown_by_grid(*target)) : 0;
  if (finest == 0) finest = finest_focal_px(lens, camera_from_view, *asked, std::nullopt);
  if (finest == 0) return std::nullopt;
  const double focal_px =
      std::min(std::max(finest * supersampling, min_focal_px(extent, finest)), largest_focal_px(*asked, max_size_px));
  return view_of(view_from_camera, *asked, focal_px, {0, 0});
}

// A view in the plane of a pinhole's image; none where the lens is no pinhole with square pixels, or the body is too
// wide or needs a coarser view.
std::optional<VirtualCamera> view_in_image_plane(const Camera& camera, const Corners& corners,
                                                 const std::optional<cv::Rect>& target, double supersampling,
                                                 int max_size_px) {
  constexpr double kLargestFactor = 64;  // beyond, too few of OpenGL's 24 bits are left for a body off the axis
  const LensParameters& p = camera.lens.parameters();
  if (!camera.lens.is_pinhole() || p.fx != p.fy) return std::nullopt;
  const glm::dquat straight(1, 0, 0, 0);
  const Extent body = extent_in(straight, corners);
  if (body.too_wide) return std::nullopt;
  const glm::dvec2 center(p.cx, p.cy);
  Extent asked = body;
  if (target) {
    const glm::dvec2 corner(target->x - 0.5, target->y - 0.5);
    asked.low = glm::max(body.low, (corner - center) / p.fx);
    asked.high = glm::min(body.high, (corner + glm::dvec2(target->width, target->height) - center) / p.fx);
    if (asked.low.x >= asked.high.x || asked.low.y >= asked.high.y) return std::nullopt;
  }
  const double wanted = std::ceil(std::max(supersampling, min_focal_px(body, p.fx) / p.fx));
  const double factor = std::min(wanted, std::floor(largest_focal_px(asked, max_size_px) / p.fx));
  if (!(factor >= 1 && factor <= kLargestFactor)) return std::nullopt;
  // The image's left edge, at tangent -(cx + 0.5) / fx, falls on an edge between the view's pixels.
  return view_of(straight, asked, factor * p.fx, glm::fract(factor * (center + 0.5) - 0.5));
}

// The rotations from the camera to the faces of a cube around it.
std::vector<glm::dquat> cube_rotations() {
  std::vector<glm::dquat> rotations;
  for (const glm::dvec3& axis : {glm::dvec3{1, 0, 0}, glm::dvec3{0, 1, 0}, glm::dvec3{0, 0, 1}, glm::dvec3{-1, 0, 0},
                                 glm::dvec3{0, -1, 0}, glm::dvec3{0, 0, -1}})
    rotations.push_back(rotation_to_axis(axis));
  return rotations;
}

}  // namespace

std::vector<VirtualCamera> virtual_cameras(LensTable& lens, const Corners& corners_in_camera,
                                           const std::optional<cv::Rect>& target, double supersampling,
                                           int max_size_px) {
  ENSURE(supersampling >= 1 && max_size_px >= 64);
  if (const auto view = view_in_image_plane(lens.camera(), corners_in_camera, target, supersampling, max_size_px))
    return {*view};
  glm::dvec3 middle(0);
  for (const glm::dvec3& corner : corners_in_camera) middle += corner / 8.0;
  const double distance_m = glm::length(middle);
  std::vector<glm::dquat> rotations{rotation_to_axis(distance_m > 0 ? middle / distance_m : glm::dvec3(1, 0, 0))};
  Extent extent = extent_in(rotations.front(), corners_in_camera);
  if (extent.too_wide) {
    // A little wider than 90 degrees, so that interpolation at an edge finds colour.
    extent = {.low = glm::dvec2(-1.02), .high = glm::dvec2(1.02)};
    rotations = cube_rotations();
  }
  const TargetRays rays = target ? rays_over(*target, lens) : TargetRays{};
  const double half_angle_rad = std::atan(glm::length(glm::max(glm::abs(extent.low), glm::abs(extent.high))));
  if (target && rotations.size() == 1 && !is_looked_at(rays, middle, half_angle_rad)) return {};
  std::vector<VirtualCamera> views;
  for (const glm::dquat& rotation : rotations)
    if (const auto view = cut_view(lens, rotation, extent, target, rays, supersampling, max_size_px))
      views.push_back(*view);
  return views;
}

std::vector<VirtualCamera> virtual_cameras(const Camera& camera, const Corners& corners_in_camera,
                                           const std::optional<cv::Rect>& target, double supersampling,
                                           int max_size_px) {
  LensTable lens(camera);
  return virtual_cameras(lens, corners_in_camera, target, supersampling, max_size_px);
}

}  // namespace sigs
