// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>

namespace sigs::truth {

// IEC 61966-2-1 (sRGB), 0..1 both ways.
[[nodiscard]] inline double light_of_code(double code) {
  return code <= 0.04045 ? code / 12.92 : std::pow((code + 0.055) / 1.055, 2.4);
}
[[nodiscard]] inline double code_of_light(double light) {
  return light <= 0.0031308 ? 12.92 * light : 1.055 * std::pow(light, 1 / 2.4) - 0.055;
}

}  // namespace sigs::truth
