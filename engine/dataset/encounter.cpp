// SPDX-License-Identifier: MIT
#include "dataset/encounter.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/ensure.h"
#include "base/text.h"

namespace sigs {

namespace {

// Taylor series of cosine and sine for |x| <= pi/4, where the first term left out is under 1e-18.
CosSin series(double x) {
  const double square = x * x;
  double cos = 0;
  double sin = 0;
  for (int n = 18; n > 0; n -= 2) {
    cos = (1 + cos) * -square / (n * (n - 1));
    sin = (1 + sin) * -square / (n * (n + 1));
  }
  return {1 + cos, x * (1 + sin)};
}

// Unit vectors in world axes, for a viewer who looks in the direction from which the intruder comes (`toward`).
struct SideAxes {
  glm::dvec3 toward{1, 0, 0};
  glm::dvec3 right{0, 1, 0};
  glm::dvec3 above{0, 0, -1};
};

SideAxes view_along(double bearing_deg, double elevation_deg) {
  const CosSin bearing = cos_sin_of_deg(bearing_deg);
  const CosSin elevation = cos_sin_of_deg(elevation_deg);
  return {.toward = {elevation.cos * bearing.cos, elevation.cos * bearing.sin, -elevation.sin},
          .right = {-bearing.sin, bearing.cos, 0},
          .above = {-elevation.sin * bearing.cos, -elevation.sin * bearing.sin, -elevation.cos}};
}

std::string metres(double value_m) {
  return short_number_text(value_m) + " m";
}

// The length of the relative path from the first frame to the CPA: Pythagoras.
Possible<double> path_length_m(double range_m, double miss_m) {
  if (range_m < miss_m)
    return tl::unexpected(fmt::format("range_m: the intruder starts {} away, nearer than the miss distance of {}",
                                      metres(range_m), metres(miss_m)));
  return std::sqrt((range_m - miss_m) * (range_m + miss_m));
}

}  // namespace

double min_range_m(const RelativeMotion& motion, double length_s) {
  const double speed_squared = glm::dot(motion.velocity_mps, motion.velocity_mps);
  const double closest_s = speed_squared > 0 ? -glm::dot(motion.start_m, motion.velocity_mps) / speed_squared : 0;
  return glm::length(motion.at(std::clamp(closest_s, 0.0, length_s)));
}

RelativeMotion relative_motion(const Encounter& encounter) {
  const SideAxes view = view_along(encounter.bearing_deg, encounter.elevation_deg);
  const CosSin side = cos_sin_of_deg(encounter.miss_angle_deg);
  const glm::dvec3 miss_m = encounter.miss_distance_m * (side.cos * view.right + side.sin * view.above);
  const double path_length_m = encounter.closing_speed_mps * encounter.time_of_closest_approach_s;
  return {.start_m = miss_m + path_length_m * view.toward, .velocity_mps = -encounter.closing_speed_mps * view.toward};
}

double first_range_m(const Encounter& encounter) {
  return glm::length(relative_motion(encounter).start_m);
}

Possible<Encounter> timed_encounter(Encounter encounter, const EncounterTiming& timing) {
  ENSURE(timing.closing_speed_mps.has_value() + timing.time_of_closest_approach_s.has_value() +
             timing.range_m.has_value() ==
         2);
  encounter.closing_speed_mps = timing.closing_speed_mps.value_or(0);
  encounter.time_of_closest_approach_s = timing.time_of_closest_approach_s.value_or(0);
  if (timing.closing_speed_mps && *timing.closing_speed_mps <= 0)
    return tl::unexpected(
        fmt::format("closing_speed_mps: {} m/s cannot meet the miss distance of {}: the intruder never comes nearer",
                    short_number_text(*timing.closing_speed_mps), metres(encounter.miss_distance_m)));
  if (!timing.range_m) return encounter;
  const Possible<double> path = path_length_m(*timing.range_m, encounter.miss_distance_m);
  if (!path) return tl::unexpected(path.error());
  if (timing.closing_speed_mps) {
    encounter.time_of_closest_approach_s = *path / *timing.closing_speed_mps;
    return encounter;
  }
  encounter.closing_speed_mps = *path / std::abs(*timing.time_of_closest_approach_s);
  if (*path == 0 || !std::isfinite(encounter.closing_speed_mps))
    return tl::unexpected(fmt::format("range_m: no closing speed leads from {} to the miss distance of {} in {} s",
                                      metres(*timing.range_m), metres(encounter.miss_distance_m),
                                      short_number_text(*timing.time_of_closest_approach_s)));
  return encounter;
}

CosSin cos_sin_of_deg(double angle_deg) {
  int quarter = 0;
  const double rest_deg = std::remquo(angle_deg, 90.0, &quarter);  // exact; the quarters' last three bits
  const CosSin first = series(rest_deg * (std::numbers::pi / 180));
  switch (quarter & 3) {
    case 1:
      return {-first.sin, first.cos};
    case 2:
      return {-first.cos, -first.sin};
    case 3:
      return {first.sin, -first.cos};
    default:
      return first;
  }
}

}  // namespace sigs
