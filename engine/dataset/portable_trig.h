// SPDX-License-Identifier: MIT
#pragma once

namespace sigs {

struct CosSin {
  double cos = 1;
  double sin = 0;
};

// Of an angle in degrees, to 2e-16 and exact at multiples of 90. Sums and products alone: unlike those of the C
// library, every machine gives the same bits, so that parts of a dataset made on different ones fit together.
[[nodiscard]] CosSin cos_sin_of_deg(double angle_deg);

}  // namespace sigs
