// SPDX-License-Identifier: MIT
#pragma once

#include <glm/glm.hpp>

#include "geo/geodetic.h"
#include "scene/scene.h"
#include "scene/scene_parts.h"

namespace sigs {

// Where the sun stands as seen from a place.
struct SunPosition {
  double azimuth_rad = 0;    // from true north to the right, 0..2 pi
  double elevation_rad = 0;  // of its middle above the horizon, without refraction
};

// The sun's apparent position by the low-precision theory of Meeus, Astronomical Algorithms (2nd edition), chapters 12,
// 13, 22 and 25, which NOAA's solar calculator follows; within 0.01 degrees from 1900 to 2100. Parallax (0.002 degrees)
// is neglected.
//   utc_s  seconds since 1970-01-01 00:00 UTC without leap seconds
//   place  latitude and longitude; the height does not matter
[[nodiscard]] SunPosition sun_position(double utc_s, const GeodeticPosition& place);

// How much higher than without air the sun is seen, at sea level, 1010 hPa and 10 degrees (Saemundsson 1986; Meeus eq.
// 16.4). 0.48 degrees at the horizon; below it by one degree as there.
[[nodiscard]] double refraction_rad(double elevation_rad);

// The sun's direction and how much of it is above the horizon.
struct Sunlight {
  glm::dvec3 to_sun{0, 0, -1};  // unit vector, world
  double visible_share = 1;     // 0..1: of the disc, 0.53 degrees high; 0: the sun has set
};

// The sun at a time of the footage: azimuth and elevation as the scene's light has them; what it does not have follows
// from the scene's place on the Earth and its time, with refraction. Straight up where that is not known either.
[[nodiscard]] Sunlight sunlight_at(const Scene& scene, double time_s);

// Checks that the sun's direction is known: a problem with light.sun.azimuth_deg or light.sun.elevation_deg where
// light.kind is sun, the project leaves it out, and the scene does not know place and time.
[[nodiscard]] Result<SceneLight, Problem> scene_light(const Project& project, const Scene& scene);

// In place of a light with a problem: the sun half way up, ahead and to the right.
[[nodiscard]] SceneLight placeholder_light(const SceneLight& light);

}  // namespace sigs
