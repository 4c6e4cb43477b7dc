// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "loft.h"
#include "model.h"

namespace sigs::models {

// Blades that turn. Their disc is a material of its own, whose statements let the renderer turn them.
struct TurningBlades {
  std::string material;
  int count = 2;
  double root_m = 0.1;  // radius at which the blades begin
  double tip_m = 1;     // and end
  double root_chord_m = 0.1;
  double tip_chord_m = 0.1;
  double rpm = 0;       // positive: counter-clockwise for an eye to which the disc's x axis points
  double coning_m = 0;  // how much higher (+x) the tips lie than the roots
  double reflectance = 0.05;
};

// The ring around the x axis in which the blades are, one layer, facing +x. Its rims lie beyond roots and tips, so that
// no blade is cut by the straight sides.
[[nodiscard]] Patch blade_disc(const TurningBlades& blades, int rings, int sides);

// Matt, so that no glass is seen in it. For programs that know no rotors it is as opaque as the blades are on average.
[[nodiscard]] MaterialSpec blade_material(const TurningBlades& blades);

}  // namespace sigs::models
