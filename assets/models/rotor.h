// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "loft.h"
#include "model.h"

namespace sigs::models {

// Blades that turn while the shutter is open.
struct TurningBlades {
  int count = 2;
  double root_m = 0.1;  // radius at which the blades begin
  double tip_m = 1;     // and end
  double root_chord_m = 0.1;
  double tip_chord_m = 0.1;
  double sweep_rad = 6.3;      // by how much a blade turns; from 2 pi / count on, the disc is alike all around
  double coning_m = 0;         // how much higher (+x) the tips lie than the roots
  double first_blade_rad = 0;  // where the middle of the first blade's sweep lies
};

// The blurred disc around the x axis, one layer, seen from both sides. Its opacity is the share of the time in which a
// blade is before a place: min(chord / radius, sweep) / sweep in the middle of the sweep, less towards its ends. Each
// cell takes the next of the opacities that rotor_materials() has; cells below half the smallest are left out.
[[nodiscard]] Patch blurred_disc(const TurningBlades& blades, int rings, int sides);

// Materials of the blurred discs: matt, so that no glass is seen in them.
[[nodiscard]] std::vector<MaterialSpec> rotor_materials(double reflectance);

}  // namespace sigs::models
