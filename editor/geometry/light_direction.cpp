// SPDX-License-Identifier: MIT
#include "editor/geometry/light_direction.h"

#include <cmath>
#include <numbers>

namespace sigs::editor {

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
