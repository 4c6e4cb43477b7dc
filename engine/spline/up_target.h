// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "spline/trajectory.h"

namespace sigs {

// What is known of a flight at one moment, for choosing the roll.
struct FlightSample {
  double time_s = 0;
  glm::dvec3 nose{1, 0, 0};                 // unit
  glm::dvec3 specific_force_mps2{0, 0, 0};  // acceleration less gravity
};

// Where the aircraft's up axis (body -Z) should point: unit and across the nose, and how much that is worth, 0..1.
// Weight 0: any roll will do, and up is zero.
struct UpTarget {
  glm::dvec3 up{0, 0, 0};
  double weight = 0;
};

// The level up across a nose: world up, as far as it goes. Its length is the cosine of the pitch.
[[nodiscard]] glm::dvec3 level_up(const glm::dvec3& nose);

// Bank::coordinated: up is along the specific force across the nose, so that nothing pulls sideways; in a level turn
// the bank is atan(v * turn_rate / g), right wing down in a right turn. Its angle from the level up is at most
// bank_limit_rad where the pitch is under 60 degrees; steeper, the limit opens, and from 75 degrees on there is none.
// Upside down only over the top of a loop: between two passes through such steepness, or before the first and after
// the last one, the flight is inverted if the force points down on the whole (and the limit counts from inverted);
// a flight that never gets that steep stays upright, and pushes instead, however hard its path bends down.
// Bank::level: up is the level up.
// samples: in order of time, at least one.
[[nodiscard]] std::vector<UpTarget> up_targets(std::span<const FlightSample> samples, Bank bank, double bank_limit_rad);

}  // namespace sigs
