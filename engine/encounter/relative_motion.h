// SPDX-License-Identifier: MIT
#pragma once

#include <glm/glm.hpp>

namespace sigs {

// How two aircraft move against each other at one moment, and what follows if both went on straight at constant
// velocity. World axes: X north, Y east, Z down (or the world of a project, whose X has a heading), metres and m/s.
// Vertical numbers are positive upwards: the intruder is above the ownship, or climbs against it.

struct AircraftState {
  glm::dvec3 position_m{0, 0, 0};
  glm::dvec3 velocity_mps{0, 0, 0};
};

// Intruder less ownship.
struct RelativeState {
  glm::dvec2 horizontal_m{0, 0};  // s: world X and Y
  glm::dvec2 horizontal_mps{0, 0};
  double vertical_m = 0;  // upwards
  double vertical_mps = 0;
};

// The positions are subtracted first: nothing is lost 1e7 m from the world's origin.
[[nodiscard]] RelativeState relative_state(const AircraftState& own, const AircraftState& intruder);

// Whether all six numbers are finite. What is not is answered with NaN, "not lost" or nothing by all functions here
// and in well_clear.h.
[[nodiscard]] bool is_finite(const RelativeState& state);

// Straight horizontal flight, as the formulas of well_clear.h need it. `u` is the direction of the relative velocity.
// Correct to the last bits at any speed, 1e-9 m/s and 1e7 m apart too: neither the speed nor the distance is squared.
struct HorizontalLine {
  double speed_mps = 0;   // |v|
  double along_m = 0;     // s.u, negative while closing; 0 where the speed is 0
  double across_m = 0;    // |s x u|: the distance at closest approach, past or to come; |s| where the speed is 0
  double distance_m = 0;  // |s|
};
[[nodiscard]] HorizontalLine horizontal_line(const RelativeState& state);

// All that is said of one moment. A state that is not finite: all NaN.
struct RelativeQuantities {
  double range_m = 0;             // slant
  double horizontal_range_m = 0;  // |s|
  double vertical_m = 0;          // upwards, from the ownship to the intruder

  // Rate of the slant range; negative while it falls. At range 0 it can only grow: the relative speed.
  double range_rate_mps = 0;
  double closing_speed_mps = 0;     // -range_rate_mps
  double horizontal_speed_mps = 0;  // |v|: what a distant range falls by in a collision course

  // To the right of the ownship's course over ground, -pi < bearing <= pi. A hovering or vertically flying ownship
  // (below kHover_mps) has no course: against world X. An intruder straight above, below or in the same place: 0.
  double bearing_rad = 0;
  // Above the horizontal plane, -pi/2..pi/2; in the same place: 0.
  double elevation_rad = 0;

  // Until the horizontal distance is least, on straight flight from this moment on: max(0, -s.v / |v|^2). 0 where the
  // distance grows or does not change (diverging, parallel, vertical, hovering, identical).
  double time_to_closest_s = 0;
  double hmd_m = 0;  // horizontal distance at that time
  double vmd_m = 0;  // vertical_m at that time

  // Until both are at one height, on straight flight: -sz / vz. 0 where they are, also for ever; infinite where the
  // heights diverge or differ for ever.
  double time_to_coaltitude_s = 0;
};
inline constexpr double kHover_mps = 1e-6;

[[nodiscard]] RelativeQuantities relative_quantities(const AircraftState& own, const AircraftState& intruder);

// Modified tau with the distance D: (D^2 - |s|^2) / (s.v), the time until |s| reaches D at a rate that is adapted to
// passing. 0 within D; infinite where the distance does not fall. (RTCA DO-365.)
//   dmod_m  at least 0
[[nodiscard]] double tau_mod_s(const RelativeState& state, double dmod_m);

// See RelativeQuantities.
[[nodiscard]] double time_to_coaltitude_s(const RelativeState& state);

}  // namespace sigs
