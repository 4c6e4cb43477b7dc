// SPDX-License-Identifier: MIT
#include "scene/scene_light.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "base/pose.h"

namespace sigs {

namespace {

constexpr double kDay_s = 86400;
constexpr double kDiscRadius_deg = 0.2666;   // at the mean distance; it varies by 2 %
constexpr double kTerrestrialTime_s = 69.2;  // TT - UTC in 2017 to 2026; 30 s more move the sun by 0.0003 degrees

double sin_deg(double angle_deg) {
  return std::sin(rad_of_deg(angle_deg));
}

double cos_deg(double angle_deg) {
  return std::cos(rad_of_deg(angle_deg));
}

// Place in the sky against the Earth's axis.
struct Equatorial {
  double right_ascension_rad;
  double declination_rad;
};

// Meeus chapter 25, "low accuracy", with the apparent longitude: aberration and the largest term of nutation.
//   centuries  since J2000.0, terrestrial time
Equatorial apparent_sun(double centuries) {
  const double t = centuries;
  const double mean_longitude_deg = 280.46646 + t * (36000.76983 + t * 0.0003032);  // eq. 25.2
  const double anomaly_deg = 357.52911 + t * (35999.05029 - t * 0.0001537);         // eq. 25.3
  const double center_deg = (1.914602 - t * (0.004817 + t * 0.000014)) * sin_deg(anomaly_deg) +
                            (0.019993 - t * 0.000101) * sin_deg(2 * anomaly_deg) + 0.000289 * sin_deg(3 * anomaly_deg);
  const double node_deg = 125.04 - 1934.136 * t;
  const double longitude_deg = mean_longitude_deg + center_deg - 0.00569 - 0.00478 * sin_deg(node_deg);
  const double obliquity_deg = 23.4392911 - t * (0.0130042 + t * (1.64e-7 - t * 5.04e-7))  // eq. 22.2
                               + 0.00256 * cos_deg(node_deg);                              // eq. 25.8
  return {std::atan2(cos_deg(obliquity_deg) * sin_deg(longitude_deg), cos_deg(longitude_deg)),
          std::asin(sin_deg(obliquity_deg) * sin_deg(longitude_deg))};
}

// Meeus eq. 12.4, with the nutation in longitude that apparent_sun() has. UTC stands for UT1, from which it differs by
// less than 0.9 s: 0.004 degrees.
//   days  since J2000.0, universal time
double apparent_sidereal_time_deg(double days) {
  const double t = days / 36525;
  const double mean_deg = 280.46061837 + 360.98564736629 * days + t * t * (0.000387933 - t / 38710000);
  return mean_deg - 0.00478 * sin_deg(125.04 - 1934.136 * t) * cos_deg(23.44);
}

glm::dvec3 ned_direction(double azimuth_rad, double elevation_rad) {
  return {std::cos(elevation_rad) * std::cos(azimuth_rad), std::cos(elevation_rad) * std::sin(azimuth_rad),
          -std::sin(elevation_rad)};
}

// Share of a disc of radius 1 whose middle is `height` above a straight edge.
double share_above(double height) {
  if (height >= 1) return 1;
  if (height <= -1) return 0;
  return (std::numbers::pi / 2 + std::asin(height) + height * std::sqrt(1 - height * height)) / std::numbers::pi;
}

bool knows_sky(const Scene& scene) {
  return scene.earth.has_value() && scene.utc_at_frame_0_s.has_value();
}

std::string missing(const Scene& scene) {
  if (!scene.earth) return scene.utc_at_frame_0_s ? "the footage's place on the Earth is" : "time and place are";
  return "the footage's time is";
}

tl::unexpected<Problem> unknown_direction(const std::string& field, const Scene& scene) {
  return tl::unexpected<Problem>(
      Problem{"light.sun." + field,
              "is not set, and cannot be computed, as " + missing(scene) +
                  " not known; set it, or name a camera.track with UTC and place (sigs telemetry FILE lists what it "
                  "has), or set light.kind to point"});
}

}  // namespace

SunPosition sun_position(double utc_s, const GeodeticPosition& place) {
  constexpr double kJ2000_s = 946728000;  // 2000-01-01 12:00 UTC since 1970
  const double days = (utc_s - kJ2000_s) / kDay_s;
  const Equatorial sun = apparent_sun((days + kTerrestrialTime_s / kDay_s) / 36525);
  const double hour_angle_rad =
      rad_of_deg(std::fmod(apparent_sidereal_time_deg(days), 360) + place.longitude_deg) - sun.right_ascension_rad;
  // As a vector: north, east, up. Meeus eq. 13.5 and 13.6 without their division by zero at the zenith.
  const double latitude_rad = rad_of_deg(place.latitude_deg);
  const double across = std::cos(sun.declination_rad) * std::cos(hour_angle_rad);
  const double along = std::sin(sun.declination_rad);
  const double north = along * std::cos(latitude_rad) - across * std::sin(latitude_rad);
  const double east = -std::cos(sun.declination_rad) * std::sin(hour_angle_rad);
  const double up = along * std::sin(latitude_rad) + across * std::cos(latitude_rad);
  const double azimuth_rad = std::atan2(east, north);
  return {azimuth_rad < 0 ? azimuth_rad + 2 * std::numbers::pi : azimuth_rad, std::atan2(up, std::hypot(north, east))};
}

double refraction_rad(double elevation_rad) {
  const double elevation_deg = std::clamp(deg_of_rad(elevation_rad), -1.0, 89.0);
  const double minutes = 1.02 / std::tan(rad_of_deg(elevation_deg + 10.3 / (elevation_deg + 5.11)));
  return rad_of_deg(std::max(minutes, 0.0) / 60);
}

Sunlight sunlight_at(const Scene& scene, double time_s) {
  SunPosition sun{0, std::numbers::pi / 2};  // in the world's axes from here on: azimuth from X
  const SceneLight& light = scene.light;
  if (!(light.sun_azimuth_rad && light.sun_elevation_rad) && knows_sky(scene)) {
    sun = sun_position(*scene.utc_at_frame_0_s + time_s, scene.earth->origin());
    sun.azimuth_rad -= scene.earth->heading_rad();
    sun.elevation_rad += refraction_rad(sun.elevation_rad);
  }
  sun.azimuth_rad = light.sun_azimuth_rad.value_or(sun.azimuth_rad);
  sun.elevation_rad = light.sun_elevation_rad.value_or(sun.elevation_rad);
  return {ned_direction(sun.azimuth_rad, sun.elevation_rad),
          share_above(deg_of_rad(sun.elevation_rad) / kDiscRadius_deg)};
}

Result<SceneLight, Problem> scene_light(const Project& project, const Scene& scene) {
  if (scene.light.kind == LightKind::sun && !knows_sky(scene)) {
    if (!project.light.sun.azimuth_deg) return unknown_direction("azimuth_deg", scene);
    if (!project.light.sun.elevation_deg) return unknown_direction("elevation_deg", scene);
  }
  return scene.light;
}

SceneLight placeholder_light(const SceneLight& light) {
  SceneLight placed = light;
  placed.sun_azimuth_rad = light.sun_azimuth_rad.value_or(rad_of_deg(45));
  placed.sun_elevation_rad = light.sun_elevation_rad.value_or(rad_of_deg(45));
  return placed;
}

}  // namespace sigs
