// SPDX-License-Identifier: MIT
#pragma once

#include <glm/glm.hpp>

namespace sigs::editor {

// Where a light stands as seen from a place: bearing from world X to the right, elevation above the horizon.
struct LightDirection {
  double bearing_rad = 0;    // (-pi, pi]
  double elevation_rad = 0;  // [-pi/2, pi/2]
  double distance_m = 0;
};
// A light at the very place itself: all zero.
[[nodiscard]] LightDirection direction_of(const glm::dvec3& light_m, const glm::dvec3& from_m);
[[nodiscard]] glm::dvec3 position_of(const LightDirection& direction, const glm::dvec3& from_m);

}  // namespace sigs::editor
