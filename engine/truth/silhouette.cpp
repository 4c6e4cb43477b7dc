// SPDX-License-Identifier: MIT
#include "truth/silhouette.h"

#include <limits>

namespace sigs {

namespace {

template <class PixelOf>
std::optional<Silhouette> silhouette_by(std::span<const glm::vec3> points_in_body, const PixelOf& pixel_of) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  glm::dvec2 low(kInfinity), high(-kInfinity);
  bool all_have_image = true;
  for (const glm::vec3& point : points_in_body) {
    const std::optional<glm::dvec2> pixel = pixel_of(glm::dvec3(point));
    all_have_image = all_have_image && pixel;
    if (!pixel) continue;
    low = glm::min(low, *pixel);
    high = glm::max(high, *pixel);
  }
  if (low.x > high.x) return std::nullopt;
  return Silhouette{.box = {low.x, low.y, high.x - low.x, high.y - low.y}, .all_have_image = all_have_image};
}

}  // namespace

std::optional<Silhouette> silhouette_of(std::span<const glm::vec3> points_in_body,
                                        const Pose<frame::Camera, frame::Body>& camera_from_body, const Lens& lens) {
  return silhouette_by(points_in_body, [&](const glm::dvec3& point) { return lens.pixel(camera_from_body * point); });
}

std::optional<Silhouette> silhouette_of(std::span<const glm::vec3> points_in_body, const RowMotion& motion,
                                        const Lens& lens) {
  return silhouette_by(points_in_body, [&](const glm::dvec3& point) { return motion.pixel(lens, point); });
}

}  // namespace sigs
