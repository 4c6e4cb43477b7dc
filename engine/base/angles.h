// SPDX-License-Identifier: MIT
#pragma once

#include <numbers>

namespace sigs {

// Degrees exist in files and on screen only; these two functions convert.
[[nodiscard]] constexpr double rad_of_deg(double deg) {
  return deg * (std::numbers::pi / 180.0);
}
[[nodiscard]] constexpr double deg_of_rad(double rad) {
  return rad * (180.0 / std::numbers::pi);
}

}  // namespace sigs
