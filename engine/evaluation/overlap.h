// SPDX-License-Identifier: MIT
#pragma once

#include "base/image.h"

namespace sigs {

// Intersection over union (Jaccard index) of the areas of two boxes, 0 to 1. 0 where they do not intersect or one has
// no area.
[[nodiscard]] double overlap(const Box& a, const Box& b);

// Whether value is greater than threshold by more than 1e-9, so that rounding of decimals does not matter: 5 px may be
// stored as 5.000000000000001.
[[nodiscard]] bool exceeds(double value, double threshold);

}  // namespace sigs
