// SPDX-License-Identifier: MIT
#include "truth/silhouette.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sigs {

namespace {

// A box that grows by the images of points.
class GrowingBox {
 public:
  void add(const std::optional<glm::dvec2>& pixel) {
    ++asked_;
    if (!pixel) {
      all_have_image_ = false;
      return;
    }
    low_ = glm::min(low_, *pixel);
    high_ = glm::max(high_, *pixel);
  }

  // Whether all within `reach_px` of the pixel lies in the box.
  [[nodiscard]] bool has_around(const glm::dvec2& pixel, double reach_px) const {
    return pixel.x - reach_px > low_.x && pixel.y - reach_px > low_.y && pixel.x + reach_px < high_.x &&
           pixel.y + reach_px < high_.y;
  }

  [[nodiscard]] std::optional<Silhouette> silhouette() const {
    if (low_.x > high_.x) return std::nullopt;
    return Silhouette{{low_.x, low_.y, high_.x - low_.x, high_.y - low_.y}, all_have_image_, asked_};
  }

 private:
  static constexpr double kInfinity = std::numeric_limits<double>::infinity();
  glm::dvec2 low_{kInfinity};
  glm::dvec2 high_{-kInfinity};
  bool all_have_image_ = true;
  std::int64_t asked_ = 0;
};

template <class PixelOf>
std::optional<Silhouette> silhouette_by(std::span<const glm::vec3> points_in_body, const PixelOf& pixel_of) {
  GrowingBox box;
  for (const glm::vec3& point : points_in_body) box.add(pixel_of(glm::dvec3(point)));
  return box.silhouette();
}

// How far the image of a point moves, at most, when its direction turns by an angle: px per radian, for directions
// around the body. Nothing where that is not known well enough.
std::optional<double> magnification_around(const PointTree::Group& body,
                                           const Pose<frame::Camera, frame::Body>& camera_from_body, const Lens& lens) {
  constexpr double kMaxAcross_rad = 0.1;
  constexpr double kSimilar = 0.8;
  constexpr double kMargin = 1.3;
  const glm::dvec3 middle = camera_from_body * glm::dvec3(body.middle_m);
  const double distance_m = glm::length(middle);
  if (!(body.radius_m < kMaxAcross_rad * distance_m)) return std::nullopt;
  const double from_axis_rad = std::atan2(std::hypot(middle.y, middle.z), middle.x);
  if (!(from_axis_rad + 2 * std::asin(body.radius_m / distance_m) < lens.valid_angle_rad())) return std::nullopt;
  double least = lens.pixels_per_radian(middle), most = least;
  for (int corner = 0; corner < 8; ++corner) {
    const glm::dvec3 out(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1);
    const double there = lens.pixels_per_radian(middle + body.radius_m * out);
    least = std::min(least, there);
    most = std::max(most, there);
  }
  if (!(least > kSimilar * most)) return std::nullopt;
  return kMargin * most;
}

}  // namespace

std::optional<Silhouette> silhouette_of(std::span<const glm::vec3> points_in_body,
                                        const Pose<frame::Camera, frame::Body>& camera_from_body, const Lens& lens) {
  return silhouette_by(points_in_body, [&](const glm::dvec3& point) { return lens.pixel(camera_from_body * point); });
}

std::optional<Silhouette> silhouette_by_groups(const PointTree& points_in_body,
                                               const Pose<frame::Camera, frame::Body>& camera_from_body,
                                               const Lens& lens) {
  const std::vector<PointTree::Group>& groups = points_in_body.groups;
  if (groups.empty()) return std::nullopt;
  const std::optional<double> px_per_rad = magnification_around(groups.front(), camera_from_body, lens);
  if (!px_per_rad) return silhouette_of(std::span(points_in_body.points_m), camera_from_body, lens);
  GrowingBox box;
  std::vector<std::size_t> left{0};  // larger groups first: their middles are far apart and make the box large early
  for (std::size_t i = 0; i < left.size(); ++i) {
    const PointTree::Group& group = groups[left[i]];
    const glm::dvec3 middle = camera_from_body * glm::dvec3(group.middle_m);
    const std::optional<glm::dvec2> pixel = lens.pixel(middle);
    box.add(pixel);
    const double angle_rad = std::asin(std::min(1.0, group.radius_m / glm::length(middle)));
    if (pixel && box.has_around(*pixel, *px_per_rad * angle_rad)) continue;
    if (group.halves > 0) {
      left.push_back(group.halves);
      left.push_back(group.halves + 1);
      continue;
    }
    for (std::size_t k = group.first; k < group.first + group.count; ++k)
      box.add(lens.pixel(camera_from_body * glm::dvec3(points_in_body.points_m[k])));
  }
  return box.silhouette();
}

std::optional<Silhouette> silhouette_of(std::span<const glm::vec3> points_in_body, const RowMotion& motion,
                                        const Lens& lens) {
  return silhouette_by(points_in_body, [&](const glm::dvec3& point) { return motion.pixel(lens, point); });
}

}  // namespace sigs
