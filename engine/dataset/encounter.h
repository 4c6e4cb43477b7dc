// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <tl/expected.hpp>

#include "dataset/relative_motion.h"

namespace sigs {

// An encounter by its closest point of approach (CPA). Both aircraft fly on straight, before it and after it.
struct Encounter {
  double miss_distance_m = 0;  // distance at the CPA
  double miss_angle_deg = 0;   // where it passes, seen by who looks to where it comes from: 0 right, 90 above, 180 left
  double bearing_deg = 0;      // of where it comes from, to the right of the camera's direction of flight
  double elevation_deg = 0;    // the same, above the horizontal; -90..90
  double closing_speed_mps = 0;           // speed of the relative motion: the rate at which the distance falls far out
  double time_of_closest_approach_s = 0;  // after the video's first frame; may lie before it or after the last one
};

// With u the direction of bearing and elevation, r(t) = miss + (t_cpa - t) closing_speed u, miss at right angles to u.
[[nodiscard]] RelativeMotion relative_motion(const Encounter& encounter);

// Distance at the video's first frame.
[[nodiscard]] double first_range_m(const Encounter& encounter);

// Two of these say how the encounter runs in time, the third one follows.
struct EncounterTiming {
  std::optional<double> closing_speed_mps;
  std::optional<double> time_of_closest_approach_s;
  std::optional<double> range_m;  // distance at the video's first frame
};

// The encounter with speed and time as `timing` has them, of which exactly two are given. Where there is no such
// encounter, the reason in one line, which names the quantity.
[[nodiscard]] tl::expected<Encounter, std::string> timed_encounter(Encounter encounter, const EncounterTiming& timing);

}  // namespace sigs
