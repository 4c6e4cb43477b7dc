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
inline constexpr SideMap kAirlinerSides{kAirlinerNose_m, kAirlinerLength_m, 2.10, -2.10};
inline constexpr SideMap kAirlinerFin{kAirlinerNose_m - 27.0, 9.8, 8.0, 1.2};

[[nodiscard]] std::vector<MaterialSpec> airliner_materials();
[[nodiscard]] std::vector<Texture> airliner_textures();

}  // namespace sigs::models
