// SPDX-License-Identifier: MIT
#include "appearance/light_image.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sigs {

namespace {

cv::Mat_<float> elevations_of(const LightImage& image) {
  cv::Mat_<float> elevations(image.grid.size(), std::numeric_limits<float>::quiet_NaN());
  for (int y = 0; y < elevations.rows; ++y)
    for (int x = 0; x < elevations.cols; ++x) {
      const glm::dvec3& ray = image.rays.at(x, y);
      if (image.grid.hidden(y, x) != 0 || glm::dot(ray, ray) <= 0) continue;
      elevations(y, x) = static_cast<float>(std::asin(std::clamp(glm::dot(ray, image.skyline->up), -1.0, 1.0)));
    }
  return elevations;
}

}  // namespace

std::optional<double> LightImage::elevation_rad(int column, int row) const {
  if (elevations_rad.empty() || std::isnan(elevations_rad(row, column))) return std::nullopt;
  return static_cast<double>(elevations_rad(row, column));
}

LightImage LightImageReader::read(const Frame& frame, const View& view) {
  LightImage image;
  image.grid = light_grid_of(frame, view);
  image.view = view;
  if (image.empty()) return image;
  rays_.fit(image.grid, view.camera);
  image.rays = rays_;
  image.skyline = skylines_.find(image.grid, image.rays, view);
  if (image.skyline) image.elevations_rad = elevations_of(image);
  return image;
}

}  // namespace sigs
