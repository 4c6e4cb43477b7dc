// SPDX-License-Identifier: MIT
#include "frame/occluder.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

namespace sigs {

namespace {

// Point of the occluder's sphere that a ray meets: |offset + t ray| = distance, with t > 0. All of it in one frame of
// axes; none where the ray starts outside the sphere.
std::optional<glm::dvec3> on_sphere(const glm::dvec3& offset_m, const glm::dvec3& unit_ray, double distance_m) {
  const double along_m = glm::dot(offset_m, unit_ray);
  const double inside = distance_m * distance_m - glm::dot(offset_m, offset_m);
  if (!(inside > 0)) return std::nullopt;
  return offset_m + unit_ray * (std::sqrt(along_m * along_m + inside) - along_m);
}

// Bilinear; beyond the borders is nothing.
float sampled(const cv::Mat& mask, const glm::dvec2& at) {
  if (!(at.x > -1 && at.y > -1 && at.x < mask.cols && at.y < mask.rows)) return 0;
  const int x = static_cast<int>(std::floor(at.x));
  const int y = static_cast<int>(std::floor(at.y));
  const auto right = static_cast<float>(at.x - x);
  const auto down = static_cast<float>(at.y - y);
  const auto value = [&](int column, int row) {
    return column < 0 || row < 0 || column >= mask.cols || row >= mask.rows ? 0.0F : mask.at<float>(row, column);
  };
  return (1 - down) * ((1 - right) * value(x, y) + right * value(x + 1, y)) +
         down * ((1 - right) * value(x, y + 1) + right * value(x + 1, y + 1));
}

// Unit vectors along which the middles of a row's pixels look; zero where a corner of the pixel has no ray.
std::vector<glm::dvec3> middle_rays(LensTable& lens, const cv::Rect& rect, int y) {
  const auto corners_of = [&](int row) {
    const std::span<const glm::dvec3> corners = lens.corner_rays(rect.x, row, rect.width + 1);
    return std::vector<glm::dvec3>(corners.begin(), corners.end());
  };
  const std::vector<glm::dvec3> upper = corners_of(y);
  const std::vector<glm::dvec3> lower = corners_of(y + 1);
  std::vector<glm::dvec3> rays;
  for (std::size_t x = 0; x + 1 < upper.size(); ++x) {
    const std::array<glm::dvec3, 4> corners = {upper[x], upper[x + 1], lower[x], lower[x + 1]};
    const bool has_rays =
        std::none_of(corners.begin(), corners.end(), [](const glm::dvec3& corner) { return corner == glm::dvec3(0); });
    rays.push_back(has_rays ? glm::normalize(corners[0] + corners[1] + corners[2] + corners[3]) : glm::dvec3(0));
  }
  return rays;
}

}  // namespace

cv::Mat occluder_seen_from(const Pose<frame::World, frame::Camera>& world_from_camera, const Occluder& occluder,
                           LensTable& lens, const cv::Rect& rect) {
  const Pose<frame::World, frame::Camera>& made_at = occluder.world_from_camera;
  const glm::dquat made_from_now = glm::conjugate(made_at.rotation) * world_from_camera.rotation;
  const glm::dvec3 offset_m = occluder.distance_m > 0 ? glm::conjugate(made_at.rotation) *
                                                            (world_from_camera.translation_m - made_at.translation_m)
                                                      : glm::dvec3(0);
  if (made_at.rotation == world_from_camera.rotation && offset_m == glm::dvec3(0)) return occluder.mask(rect);
  cv::Mat seen = cv::Mat::zeros(rect.size(), CV_32FC1);
  for (int y = 0; y < rect.height; ++y) {
    const std::vector<glm::dvec3> rays = middle_rays(lens, rect, rect.y + y);
    for (int x = 0; x < rect.width; ++x) {
      const glm::dvec3& ray = rays[static_cast<std::size_t>(x)];
      if (ray == glm::dvec3(0)) continue;
      std::optional<glm::dvec3> point = made_from_now * ray;
      if (occluder.distance_m > 0) point = on_sphere(offset_m, *point, occluder.distance_m);
      const std::optional<glm::dvec2> pixel = point ? lens.pixel(*point) : std::nullopt;
      if (pixel) seen.at<float>(y, x) = sampled(occluder.mask, *pixel);
    }
  }
  return seen;
}

}  // namespace sigs
