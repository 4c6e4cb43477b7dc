// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>

namespace sigs {

// The transfer function between display code values (0 black, 1 white) and linear light, IEC 61966-2-1 (sRGB). It is
// used for footage, textures and MTL colours alike. Values above 1 follow the same curve and negative ones its mirror
// image, so that the two functions are inverse for the over- and undershoots that footage in Y'CbCr contains, too.
// Linear light of a display code value.
[[nodiscard]] inline float linear_of_display(float display) {
  const float size = std::fabs(display);
  const float linear = size <= 0.04045F ? size / 12.92F : std::pow((size + 0.055F) / 1.055F, 2.4F);
  return std::copysign(linear, display);
}

// Display code value of linear light.
[[nodiscard]] inline float display_of_linear(float linear) {
  const float size = std::fabs(linear);
  const float display = size <= 0.0031308F ? size * 12.92F : 1.055F * std::pow(size, 1.0F / 2.4F) - 0.055F;
  return std::copysign(display, linear);
}

}  // namespace sigs
