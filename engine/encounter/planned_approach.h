// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <tl/expected.hpp>

#include "encounter/encounter_track.h"

namespace sigs {

// An encounter by its closest approach: how a person states it, and the straight flight that makes it come true.

// The closest approach is the moment of least horizontal distance. The intruder is then beside the ownship: its
// horizontal relative velocity is perpendicular to the horizontal miss.
struct PlannedApproach {
  double time_s = 0;

  // HMD. Positive: the intruder passes on the right, for one who looks in the direction it comes from; negative: on
  // the left.
  double miss_m = 0;

  // VMD: the intruder's height above the ownship at that time.
  double vertical_miss_m = 0;

  // Horizontal relative speed at that time: the rate at which a large distance falls.
  double closing_speed_mps = 0;

  // Rate at which the intruder rises against the ownship at that time.
  double climb_mps = 0;

  // Horizontal direction that the intruder comes from, to the right of the ownship's course over ground at that time.
  // Without a course (below kHover_mps): from world X.
  double bearing_rad = 0;
};

// Position and velocity of the intruder at the closest approach; any finite numbers.
//   own  at approach.time_s
[[nodiscard]] AircraftState intruder_at(const PlannedApproach& approach, const AircraftState& own);

// The reverse: what two states amount to at a moment that is taken as the closest approach. |miss_m| is the horizontal
// distance, even where the relative velocity is not perpendicular to it. Without horizontal relative velocity the
// bearing is that which has the intruder pass on the right.
[[nodiscard]] PlannedApproach approach_of(const AircraftState& own, const AircraftState& intruder, double time_s);

// The intruder's flight: straight at constant velocity over the ownship's time. Where the ownship flies straight too,
// so is the relative motion. Where it does not, position and velocity are those of the closest approach at that time,
// and nowhere in the ownship's time does the intruder come nearer horizontally.
// Where there is no such flight: the reason in one line, which begins with the quantity to change. Reasons are a number
// that is not finite, a time outside of the ownship's, no closing speed, a camera that turns or slows down so that the
// intruder comes nearer at another time, and a place beyond kFarthestApproach_m of the world's origin.
[[nodiscard]] tl::expected<EncounterTrack, std::string> planned_flight_of(const PlannedApproach& approach,
                                                                          const EncounterTrack& own);
inline constexpr double kFarthestApproach_m = 1e8;  // in each axis, as of a project's waypoints

}  // namespace sigs
