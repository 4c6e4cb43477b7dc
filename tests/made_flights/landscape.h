// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <glm/glm.hpp>

#include "made_flights/tile.h"

namespace sigs::made {

struct LandscapeSettings {
  std::uint32_t seed = 1;
  bool moving_clouds = false;  // a layer of cumulus that the wind moves, over more than half of the sky
  bool moving_water = false;   // a lake to the right of world Y -40 m, with waves that run
};

// What a ray meets. Brightness as a luma code, 0..255.
struct Seen {
  float luma = 0;
  float sky = 0;       // share of sky and clouds, 0..1, for the colour
  bool moves = false;  // it is mostly cloud or water that moves
};

// The world of a flight: hilly fields near by, mountains and thin cloud at infinity, and what moves on its own.
// Ground heights are 0 to -40 m in world Z; the camera must be above all of them.
class Landscape {
 public:
  explicit Landscape(const LandscapeSettings& settings);

  // A ray from the camera through one pixel; the rays of its neighbours tell how wide it is. Directions are in the
  // world, of length 1.
  struct Ray {
    glm::dvec3 camera_m{0};
    glm::dvec3 direction{1, 0, 0}, right{1, 0, 0}, down{1, 0, 0};
    double time_s = 0;
  };
  [[nodiscard]] Seen seen(const Ray& ray) const;

 private:
  [[nodiscard]] Seen sky(const Ray& ray) const;
  [[nodiscard]] Seen ground(const Ray& ray) const;
  [[nodiscard]] double distance_to_ground_m(const Ray& ray) const;
  [[nodiscard]] double height_m(const glm::dvec2& p_m) const;
  [[nodiscard]] double water_m(const glm::dvec2& p_m) const;
  [[nodiscard]] float ground_luma(const glm::dvec2& p_m, double diameter_m) const;
  [[nodiscard]] float water_luma(const glm::dvec2& p_m, double diameter_m, double time_s) const;

  LandscapeSettings settings_;
  Tile fine_, fields_, hills_, panorama_, clouds_, waves_;
  float cloud_from_ = 0;
  double steepest_ = 0;  // largest slope of the ground
};

}  // namespace sigs::made
