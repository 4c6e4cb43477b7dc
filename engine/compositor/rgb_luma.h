// SPDX-License-Identifier: MIT
#pragma once

#include <array>

#include "compositor/code_patch.h"

namespace sigs {

// BT.709's weights of R', G' and B' in luma, for footage that is stored as R'G'B'.
inline constexpr std::array<double, 3> kLumaOfRgb{0.2126, 0.7152, 0.0722};

// Luma of a patch in R'G'B', as a plane of its own.
[[nodiscard]] inline PatchPlane luma_of_rgb(const CodePatch& patch) {
  const auto [r, g, b] = kLumaOfRgb;
  const auto& planes = patch.planes;
  return {.rect = planes[0].rect,
          .before = r * planes[0].before + g * planes[1].before + b * planes[2].before,
          .after = r * planes[0].after + g * planes[1].after + b * planes[2].after,
          .opacity = planes[0].opacity,
          .free = planes[0].free};
}

}  // namespace sigs
