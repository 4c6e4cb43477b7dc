// SPDX-License-Identifier: MIT
#pragma once

#include "performance/risk.h"

namespace sigs {

// One encounter of a simulation of risk: drawn (risk_encounter.cpp), flown without the system, seen by the sensor,
// flown again with the manoeuvre.

// Both flights at equal steps of time. World axes: X north, Y east, Z down.
struct FlownPair {
  double step_s = 0.1;
  double weight = 1;
  std::vector<AircraftState> own;
  std::vector<AircraftState> intruder;
};

// Steps no longer than 0.1 s, a whole number of them from each frame of the sensor to the next.
struct Steps {
  double step_s = 0.1;
  int of_frame = 1;
};
[[nodiscard]] Steps steps_of(double rate_hz);

// Drawn out of the settings, at most one number of the sequence after the other; or as recorded.
[[nodiscard]] FlownPair drawn_pair(const RiskEncounters& encounters, const Steps& steps, Random& random);
[[nodiscard]] FlownPair recorded_pair(const RiskPair& recorded, const Steps& steps);

struct FlownOutcome {
  double weight = 1;
  Geometry geometry = Geometry::head_on;
  bool is_above = false;  // the intruder, when both begin
  bool nmac_without = false, nmac_with = false;
  bool lost_without = false, lost_with = false;  // well clear
  bool is_in_view = false;   // within the sensor's field and reach at some frame before an NMAC without the system
  bool is_declared = false;  // before one
  bool is_manoeuvred = false;
};

// The encounter of this number: the same for the same settings, on any thread. Errors: those of the logic.
[[nodiscard]] Result<FlownOutcome> flown_encounter(const RiskSettings& settings, std::int64_t number,
                                                   const Logic& logic);

// Whether the models can fly and the limits make sense. Errors bad_data, usage.
[[nodiscard]] Result<void> check_flights(const RiskEncounters& encounters);

}  // namespace sigs
