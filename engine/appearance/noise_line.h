// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "appearance/noise_blocks.h"

namespace sigs {

// What a bin of brightness says.
struct NoiseLevel {
  double brightness = 0;                       // 0 black, 1 white
  double variance = 0;                         // of luma, rounding and the plane's share still in it
  double weight = 0;                           // number of blocks that agree, at most 200
  double shared = 0;                           // covariance of neighbours over the variance
  std::vector<const NoiseBlock*> blocks = {};  // without texture
};

// variance = dark * (1 - brightness) + bright * brightness
struct NoiseLine {
  double dark = 0, bright = 0;
  double dark_sd = 0, bright_sd = 0;
  bool is_level = false;  // no slope can be told
};

// The line through the levels by weighted least squares of relative errors; levels above it count less, since texture
// adds to noise and never takes away. There is at least one level.
//   is_level  no slope is looked for
[[nodiscard]] NoiseLine line_through(const std::vector<NoiseLevel>& levels, bool is_level = false);

}  // namespace sigs
