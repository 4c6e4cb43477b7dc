// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "appearance/target_silhouette.h"

namespace sigs {

// Profiles of luma and chroma across a target's outline, from the inside to the outside.
struct EdgeProfiles {
  int count = 0;                    // profiles that could be used
  std::optional<double> width_px;   // 10 to 90 % of the contrast, median
  std::optional<double> slope;      // largest slope over the contrast, 1/px, upper quartile
  std::optional<double> overshoot;  // lowest value of the mean profile beyond 10 %, negated, share of the contrast
  std::optional<double> chroma_width_px;  // 10 to 90 % of Cb and Cr along the target's mean chroma difference, median
};

// At each pixel of the outline one profile along the outline's normal, 6 px to each side, read with bicubic
// interpolation. The contrast is that of the first extremum within the outline. Profiles with little contrast, and
// those that do not come to rest outside, are left out; without 6 usable ones nothing is known.
[[nodiscard]] EdgeProfiles edge_profiles(const TargetSilhouette& target);

}  // namespace sigs
