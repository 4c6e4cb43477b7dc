// SPDX-License-Identifier: MIT
#pragma once

#include <limits>
#include <vector>

#include "editor/geometry/orbit_camera.h"

namespace sigs::editor::test {

inline constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

inline const ScreenRect kRect{{100, 50}, {900, 650}};  // wide, and not at the window's corner

// From the side, aslant, straight from above, nearly so, from below; near and far; both projections; targets far away.
[[nodiscard]] inline std::vector<OrbitCamera> example_cameras() {
  std::vector<OrbitCamera> cameras;
  for (const Projection projection : {Projection::perspective, Projection::parallel})
    for (const double elevation_rad : {0.0, 0.5, 1.5, 1.5707963267948966, -0.7})
      for (const double bearing_rad : {0.0, 0.9, -2.5})
        for (const double distance_m : {3.0, 1500.0})
          cameras.push_back({.target_m = {10 * distance_m, -5 * distance_m, -150},
                             .distance_m = distance_m,
                             .bearing_rad = bearing_rad,
                             .elevation_rad = elevation_rad,
                             .projection = projection});
  return cameras;
}

}  // namespace sigs::editor::test
