// SPDX-License-Identifier: MIT
#pragma once

#include <array>

#include "mesh/mesh.h"
#include "project/project.h"

namespace sigs {

// Parts of an aircraft that differ in heat; the order of HeatLevels.
enum class HeatPart { skin, engine, exhaust, glass, rotor };
inline constexpr std::size_t kHeatParts = 5;

// How bright a thermal camera shows each part: display values, 0 black, 1 white, beyond 1 before the camera clips.
using HeatLevels = std::array<float, kHeatParts>;

// The settings' code values above that of the sky (below, where what is warm is black), as levels; none is below 0.
[[nodiscard]] HeatLevels heat_levels_of(const HeatSettings& heat, const ThermalSettings& thermal);

// The part that a surface belongs to: a rotor by its blades, else by words in the material's name (exhaust, nozzle;
// engine, nacelle, motor and others; glass, window, canopy), else glass where it lets light through, else skin.
[[nodiscard]] HeatPart heat_part_of(const Material& material);

// Makes the mesh look as a thermal camera sees it in a light of 1 from everywhere: each surface at its part's level,
// without livery or highlights, glass opaque.
void heat_surfaces(Mesh& mesh, const HeatLevels& levels);

}  // namespace sigs
