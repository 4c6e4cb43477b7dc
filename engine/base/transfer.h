// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>

namespace sigs {

// Display code value <-> linear light, IEC 61966-2-1 (sRGB), for footage, textures and MTL colours alike. Values
// outside 0..1 go through the same curve and the negative ones through its mirror image, so that there and back is
// exact for the over- and undershoots that footage in Y'CbCr holds.
[[nodiscard]] inline float linear_of_display(float display) {
  const float size = std::fabs(display);
  const float linear = size <= 0.04045F ? size / 12.92F : std::pow((size + 0.055F) / 1.055F, 2.4F);
  return std::copysign(linear, display);
}

[[nodiscard]] inline float display_of_linear(float linear) {
  const float size = std::fabs(linear);
  const float display = size <= 0.0031308F ? size * 12.92F : 1.055F * std::pow(size, 1.0F / 2.4F) - 0.055F;
  return std::copysign(display, linear);
}

}  // namespace sigs
