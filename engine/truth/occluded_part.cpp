// SPDX-License-Identifier: MIT
#include "truth/occluded_part.h"

#include <algorithm>

namespace sigs {

double occluded_fraction(const IntruderTruth& truth) {
  if (truth.inside_fraction <= 0) return 0;
  return std::clamp(1 - truth.visible_fraction / truth.inside_fraction, 0.0, 1.0);
}

bool is_occluded(const IntruderTruth& truth) {
  constexpr double kOccluded = 0.05;
  return occluded_fraction(truth) > kOccluded;
}

}  // namespace sigs
