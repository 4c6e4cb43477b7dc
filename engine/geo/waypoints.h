// SPDX-License-Identifier: MIT
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "geo/geodetic.h"
#include "geo/recorded_path.h"

namespace sigs {

// A point of the world and when something is there.
struct WorldWaypoint {
  double time_s = 0;  // as RecordedPath::points
  glm::dvec3 position_m{0, 0, 0};
};

// The path in the world, with as many of its points as it takes: between neighbours that are left out, straight flight
// at even speed passes every point of the path, at that point's time, within tolerance_m. Of a path without times,
// which has no speed, the straight line passes every point within tolerance_m. First and last point always stay.
// Douglas and Peucker's method (Cartographica 10(2), 1973), in space and time.
//
// So a noisy path needs a tolerance above its noise: some metres for ADS-B. Heights are taken as the path has them.
//   tolerance_m  0 or more, finite; 0 keeps all points
[[nodiscard]] std::vector<WorldWaypoint> waypoints_of(const RecordedPath& path, const LocalFrame& frame,
                                                      double tolerance_m);

}  // namespace sigs
