// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "appearance/light_grid.h"
#include "appearance/skyline.h"

namespace sigs {

// One frame as the estimates of haze, tone, light and sun see it: its light on a grid, where each cell looks, and where
// the level is.
struct LightImage {
  LightGrid grid;
  GridRays rays;
  View view;
  std::optional<Skyline> skyline;
  cv::Mat_<float> elevations_rad;  // of the cells, as elevation_rad() gives them; NaN: none. Empty without a skyline

  [[nodiscard]] bool empty() const { return grid.empty(); }
  // Angle of a cell above the level, rad; nothing without a skyline, for a hidden cell and beyond the lens' field.
  // Without a camera only its sign counts.
  [[nodiscard]] std::optional<double> elevation_rad(int column, int row) const;
};

// Images of frames that follow one another; the rays of a camera are computed once.
class LightImageReader {
 public:
  [[nodiscard]] LightImage read(const Frame& frame, const View& view = {});

 private:
  GridRays rays_;
  SkylineFinder skylines_;
};

}  // namespace sigs
