// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "flights/mosaic.h"

namespace sigs::flights {

enum class Roads { winding, straight_below };  // straight_below: along world X through Y = 0, 13 m wide

// The ground below a flight and the clouds above it. Repeats after about a kilometre; `patches` (12 km) conceal that at
// a distance.
struct Terrain {
  Mosaic ground;   // channels 0..2: blue, green, red
  Mosaic patches;  // the same, to be multiplied: 128 is 1
  Mosaic clouds;   // channels 0..2: their colour, channel 3: cover
};

// detail: cells along a side of the ground, a power of two; 2048 is half a metre a cell.
[[nodiscard]] Terrain terrain(int detail, Roads roads, std::uint32_t seed);

}  // namespace sigs::flights
