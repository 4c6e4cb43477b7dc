// SPDX-License-Identifier: MIT
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "condition.h"

namespace sigs::footage {

// Cumulus with flat bases, as a density in space; heights above the ground, places as world X, Y.
class Clouds {
 public:
  static constexpr double kBase_m = 1250, kTop_m = 2100;

  explicit Clouds(const CloudCover& cover);

  // Premultiplied colour in linear light and opacity of what a ray meets. height_m: of the eye; dither: 0..1.
  [[nodiscard]] glm::vec4 along(const glm::dvec2& eye_m, double height_m, const glm::dvec3& ray_in_world,
                                double dither) const;

  // Share of the sun's light at a place on the ground.
  [[nodiscard]] float sun_share(const glm::dvec2& p_m) const;

 private:
  [[nodiscard]] float cover(const glm::dvec2& p_m) const;  // 0 clear .. 1 middle of a cloud
  [[nodiscard]] float density(const glm::dvec3& p_m, float cover_here, float detail) const;  // detail: 0..1
  [[nodiscard]] float depth_to_sun(const glm::dvec3& p_m) const;
  [[nodiscard]] float billows(const glm::dvec3& p_m) const;

  CloudCover cover_;
  std::vector<float> billows_;  // cube of noise that repeats on every side
};

}  // namespace sigs::footage
