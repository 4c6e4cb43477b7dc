// SPDX-License-Identifier: MIT
#pragma once

#include <glm/glm.hpp>
#include <optional>

#include "dataset/sample.h"

namespace sigs {

// Encounters of two aircraft that both fly straight at constant velocity. World axes: X is the camera's direction of
// flight, Y points to its right, Z down.

// The intruder's position less the camera's over time, in world axes: a straight line at constant speed.
struct RelativeMotion {
  glm::dvec3 start_m{0, 0, 0};  // at the video's first frame
  glm::dvec3 velocity_mps{0, 0, 0};

  [[nodiscard]] glm::dvec3 at(double since_first_s) const { return start_m + since_first_s * velocity_mps; }
};

// The smallest distance in the time from the first frame to `length_s` after it.
[[nodiscard]] double min_range_m(const RelativeMotion& motion, double length_s);

// An encounter by its closest point of approach (CPA).
struct Encounter {
  double miss_distance_m = 0;  // distance at the CPA
  // Side on which the intruder passes, for a viewer who looks in the direction it comes from: 0 right, 90 above,
  // 180 left.
  double miss_angle_deg = 0;
  double bearing_deg = 0;                 // direction it comes from, to the right of the camera's direction of flight
  double elevation_deg = 0;               // the same, above the horizontal; -90..90
  double closing_speed_mps = 0;           // speed of the relative motion: the rate at which a large distance falls
  double time_of_closest_approach_s = 0;  // after the video's first frame; may be before it or after the last one
};

// r(t) = miss + (t_cpa - t) closing_speed u, where u is the unit vector of bearing and elevation and miss is
// perpendicular to u.
[[nodiscard]] RelativeMotion relative_motion(const Encounter& encounter);

// Distance at the video's first frame.
[[nodiscard]] double first_range_m(const Encounter& encounter);

// How an encounter runs in time: two of the three are given, the third follows.
struct EncounterTiming {
  std::optional<double> closing_speed_mps;
  std::optional<double> time_of_closest_approach_s;
  std::optional<double> range_m;  // distance at the video's first frame
};

// The encounter with the speed and time of `timing`, in which exactly two values are given. Where there is no such
// encounter: the reason in one line, which begins with the name of the quantity.
[[nodiscard]] Possible<Encounter> timed_encounter(Encounter encounter, const EncounterTiming& timing);

struct CosSin {
  double cos = 1;
  double sin = 0;
};

// Cosine and sine of an angle in degrees, correct to 2e-16 and exact at multiples of 90. They are made of sums and
// products alone, so every machine gives the same bits, which the C library does not promise: parts of a dataset made
// on different machines fit together.
[[nodiscard]] CosSin cos_sin_of_deg(double angle_deg);

}  // namespace sigs
