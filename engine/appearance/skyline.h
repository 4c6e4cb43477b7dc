// SPDX-License-Identifier: MIT
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "appearance/light_grid.h"

namespace sigs {

// Where the level is in a frame.
struct Skyline {
  glm::dvec3 up{0, 0,
                -1};  // unit, camera axes (those of GridRays): a ray lies above the horizon where dot(ray, up) > 0
  double sd_rad = 0;  // of the direction; the dip of the horizon and hills along it are part of it
  bool from_image = false;  // found as an edge; otherwise it follows from the camera's attitude
};

// From the view's attitude, where that and the camera are known. Otherwise the great circle (or, without a camera, the
// straight line) across the image along which it is brighter above than below by most, at least 6 codes for most of
// the columns, with a sky above that is smoother than what lies below. Rolls beyond 45 degrees are not seen.
// Nothing where there is no such edge.
class SkylineFinder {
 public:
  [[nodiscard]] std::optional<Skyline> find(const LightGrid& grid, const GridRays& rays, const View& view);

  // The planes that are tried in every frame, and where they cross the columns that are looked at: the same for all
  // frames with the same rays.
  struct Planes {
    std::vector<int> columns;
    int rows = 0;
    std::vector<glm::dvec3> ups;
    std::vector<unsigned short> crossings;  // plane by plane, column by column: the first row below the plane
  };

 private:
  void fit(const std::vector<int>& columns, int rows, const GridRays& rays);

  GridRays rays_;
  Planes planes_;
};

}  // namespace sigs
