// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "appearance/noise_blocks.h"

namespace sigs {

// The share of the noise's variance that the next frame has again, over blocks whose noise dominates; 0 to 1. What
// lasts is noise that lasts and texture that hardly moves. Neighbours share as much of the noise that lasts as of the
// noise that changes, but far more of texture: so what they share of the whole that lasts divides it into both.
//   blocks  at least one, each with a next frame
[[nodiscard]] double lasting_share(std::span<const NoiseBlock* const> blocks);

}  // namespace sigs
