// SPDX-License-Identifier: MIT
#pragma once

#include "base/image.h"

namespace sigs {

// Intersection over union of two boxes' areas, 0 to 1. 0 where they do not meet or one has no area.
[[nodiscard]] double overlap(const Box& a, const Box& b);

// Whether value is more than threshold by more than rounding: numbers read as decimals leave 5 px at 5.000000000000001.
[[nodiscard]] bool exceeds(double value, double threshold);

}  // namespace sigs
