// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "base/result.h"

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

// The flight of one aircraft: position and velocity at every time between two. Exact paths give their own function,
// recorded ones are made by track_of().
struct EncounterTrack {
  std::string name;
  double first_s = 0;
  double last_s = 0;  // at least first_s

  // At a time from first_s to last_s. The velocity is the derivative of the position; at a jump of it, the one after.
  // Depends on the time alone.
  std::function<AircraftState(double time_s)> at;

  // Rising times at which the velocity or one of its derivatives jumps. Times that are not named cost accuracy: jumps
  // of the velocity are then found to 1 ms.
  std::vector<double> knots_s = {};
};

struct TrackSample {
  double time_s = 0;
  AircraftState state;
};

// A flight as recorded: states at some times.
struct SampledTrack {
  std::string name;
  std::vector<TrackSample> samples;  // by rising time
  bool has_velocities = false;       // false: velocities of the samples are not known, and are not read
};

// At least one sample, all numbers finite, times strictly rising. Error bad_data that names the track and the sample.
[[nodiscard]] Result<void> check_track(const SampledTrack& track);

// Between two samples, where velocities are known: the cubic with both positions and both velocities (Hermite), so that
// position and velocity are continuous and are the recorded ones at the samples. Where they are not known: straight
// at constant velocity; at a sample the velocity is that of the stretch after it, at the last one that before. A single
// sample without velocity hovers.
//   track  such as check_track() accepts
[[nodiscard]] EncounterTrack track_of(SampledTrack track);

}  // namespace sigs
