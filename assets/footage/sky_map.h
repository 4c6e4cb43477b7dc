// SPDX-License-Identifier: MIT
#pragma once

#include <glm/glm.hpp>
#include <opencv2/core.hpp>
#include <vector>

#include "clouds.h"

namespace sigs::footage {

// The sky ahead, ray-marched once every few metres of flight and then looked up. Between two such places
// the clouds are shifted like objects at their mean height, and blended from one to the other.
class SkyMap {
 public:
  struct Setting {
    glm::dvec2 country_m{0};  // where the flight begins, for the clouds
    float cirrus = 0;         // opacity of the thickest ice cloud
    double flight_m = 0;
    double height_m = 0;
  };
  SkyMap(const Clouds& clouds, const Setting& setting);

  // Colour in linear light, of a unit direction at or above the horizon, seen x_m after the beginning.
  [[nodiscard]] glm::vec3 color(double x_m, const glm::dvec3& ray_in_world) const;

 private:
  [[nodiscard]] cv::Mat_<cv::Vec4f> seen_from(const Clouds& clouds, double x_m) const;
  [[nodiscard]] glm::vec4 clouds_from(int place, double x_m, const glm::dvec3& ray_in_world) const;

  Setting setting_;
  double spacing_m_;
  std::vector<cv::Mat_<cv::Vec4f>> places_;  // azimuth along x, elevation along y from the horizon up
};

}  // namespace sigs::footage
