// SPDX-License-Identifier: MIT
#include "appearance/picture.h"

#include <algorithm>
#include <cmath>

namespace sigs {

std::optional<double> Picture::elevation_rad(int column, int row) const {
  if (!skyline || grid.hidden(row, column) != 0) return std::nullopt;
  const glm::dvec3& ray = rays.at(column, row);
  if (glm::dot(ray, ray) <= 0) return std::nullopt;
  return std::asin(std::clamp(glm::dot(ray, skyline->up), -1.0, 1.0));
}

Picture PictureReader::read(const Frame& frame, const View& view) {
  Picture picture;
  picture.grid = light_grid_of(frame, view);
  picture.view = view;
  if (picture.empty()) return picture;
  rays_.fit(picture.grid, view.camera);
  picture.rays = rays_;
  picture.skyline = skyline_in(picture.grid, picture.rays, view);
  return picture;
}

}  // namespace sigs
