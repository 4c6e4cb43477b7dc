// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "loft.h"
#include "model.h"
#include "side_map.h"

namespace sigs::models {

// Dimensions used by shape and paint alike. The spinner's tip lies 2.5 m ahead of the origin, under the front third of
// the wing.
inline constexpr double kLightNose_m = 2.5;
inline constexpr SideMap kLightSides{kLightNose_m, 8.3, 0.95, -0.70};
inline constexpr SideMap kLightFin{kLightNose_m - 5.1, 3.25, 1.42, 0.22};
inline constexpr PlanMap kLightUnderside{kLightNose_m, 8.3, 0.6};

// Clockwise for the pilot.
inline const TurningBlades kLightPropeller{.material = "propeller",
                                           .count = 2,
                                           .root_m = 0.10,
                                           .tip_m = 0.96,
                                           .root_chord_m = 0.17,
                                           .tip_chord_m = 0.10,
                                           .rpm = 2400,
                                           .reflectance = 0.06};

// White, grey and dark.
[[nodiscard]] std::vector<Livery> light_aircraft_liveries();

}  // namespace sigs::models
