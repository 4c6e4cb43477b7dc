// SPDX-License-Identifier: MIT
#include "editor/views/world/look.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace sigs::editor {

namespace {

constexpr double kPi = std::numbers::pi;

// A little behind and above the camera.
OrbitCamera behind_camera(const WorldSights& sights) {
  const glm::dvec3 axis = sights.world_from_camera.rotation * glm::dvec3(1, 0, 0);
  OrbitCamera eye{.distance_m = std::clamp(sights.view_depth_m * 0.18, 12.0, 400.0), .elevation_rad = 0.16};
  eye.bearing_rad = std::atan2(axis.y, axis.x);
  eye.target_m = sights.world_from_camera.translation_m + axis * (eye.distance_m * 0.4);
  return eye;
}

}  // namespace

WorldLook stood(const WorldLook& look, WorldStand stand, const WorldSights& sights, const ScreenRect& rect) {
  WorldLook result = look;
  result.stand = stand;
  result.eye = {};
  switch (stand) {
    case WorldStand::orbit:
      result.eye.bearing_rad = -0.7;
      result.eye.elevation_rad = 0.5;
      break;
    case WorldStand::top:
      result.eye.elevation_rad = kPi / 2;
      result.eye.projection = Projection::parallel;
      break;
    case WorldStand::side:  // flying to the right
      result.eye.bearing_rad = -kPi / 2;
      result.eye.projection = Projection::parallel;
      break;
    case WorldStand::camera:
      result.eye = behind_camera(sights);
      return result;
  }
  result.eye = framing(result.eye, sights.points_m, rect);
  return result;
}

WorldLook with_all_in_sight(const WorldLook& look, const WorldSights& sights, const ScreenRect& rect) {
  if (look.stand == WorldStand::camera) return stood(look, look.stand, sights, rect);
  WorldLook result = look;
  result.eye = framing(look.eye, sights.points_m, rect);
  return result;
}

}  // namespace sigs::editor
