// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "model.h"
#include "side_map.h"

namespace sigs::models {

// Dimensions used by shape and paint alike. The nose lies 17.0 m ahead of the origin, a quarter of the mean chord.
inline constexpr double kAirlinerNose_m = 17.0;
inline constexpr double kAirlinerLength_m = 37.57;
inline constexpr double kEngineY_m = 5.75;
inline constexpr double kFairingFront_m = 10.6, kFairingLength_m = 10.8;
inline constexpr SideMap kAirlinerSides{kAirlinerNose_m, kAirlinerLength_m, 2.10, -2.10};
inline constexpr SideMap kAirlinerFin{kAirlinerNose_m - 27.0, 9.8, 8.0, 1.2};
inline constexpr PlanMap kAirlinerUnderside{kAirlinerNose_m, kAirlinerLength_m, 1.7};
inline constexpr PlanMap kAirlinerFairing{kAirlinerNose_m - kFairingFront_m, kFairingLength_m, 2.2};

// White, grey and dark.
[[nodiscard]] std::vector<Livery> airliner_liveries();

}  // namespace sigs::models
