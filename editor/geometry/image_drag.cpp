// SPDX-License-Identifier: MIT
#include "editor/geometry/image_drag.h"

#include <algorithm>
#include <cmath>

namespace sigs::editor {
namespace {

constexpr double kMinDistance_m = 0.1;
constexpr double kMaxCoordinateM = 1e8;
constexpr double kDoublingPx = 100;

}  // namespace

std::optional<glm::dvec2> pixel_of(const glm::dvec3& p_in_world, const CameraPose& world_from_camera,
                                   const Lens& lens) {
  return lens.pixel(inverse(world_from_camera) * p_in_world);
}

std::optional<glm::dvec3> point_behind(const glm::dvec2& pixel, double distance_m, const CameraPose& world_from_camera,
                                       const Lens& lens) {
  if (!(distance_m > 0) || !std::isfinite(distance_m)) return std::nullopt;
  const auto ray = lens.ray(pixel);
  if (!ray) return std::nullopt;
  return world_from_camera * (*ray * distance_m);
}

std::optional<glm::dvec3> dragged_across(const glm::dvec3& start_m, const glm::dvec2& from_px, const glm::dvec2& to_px,
                                         const CameraPose& world_from_camera, const Lens& lens) {
  const auto start_px = pixel_of(start_m, world_from_camera, lens);
  if (!start_px) return std::nullopt;
  if (from_px == to_px) return start_m;
  const double distance_m = glm::distance(start_m, world_from_camera.translation_m);
  return point_behind(*start_px + (to_px - from_px), distance_m, world_from_camera, lens);
}

glm::dvec3 dragged_along(const glm::dvec3& start_m, double up_px, const CameraPose& world_from_camera) {
  if (std::isnan(up_px) || up_px == 0) return start_m;
  const glm::dvec3 from_camera = start_m - world_from_camera.translation_m;
  const double before_m = glm::length(from_camera);
  // At the camera itself there is no ray; out of the way then means along the optical axis.
  const glm::dvec3 ray = before_m > 0 ? from_camera / before_m : world_from_camera.rotation * glm::dvec3{1, 0, 0};
  const double after_m =
      std::clamp(std::max(before_m, kMinDistance_m) * std::exp2(up_px / kDoublingPx), kMinDistance_m, kMaxCoordinateM);
  return world_from_camera.translation_m + ray * after_m;
}

}  // namespace sigs::editor
