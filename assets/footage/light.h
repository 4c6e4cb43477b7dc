// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <glm/glm.hpp>

namespace sigs::footage {

// World: X forward, Y right, Z down. Linear light; 1 is a white card in full sun.

// The sun stands where the example projects put their light: (-2000, 1000, -3000), behind, to the right, 53 degrees up.
inline const glm::dvec3 kToSun = glm::normalize(glm::dvec3(-2000, 1000, -3000));
inline constexpr glm::vec3 kSunlight{1.00F, 0.955F, 0.87F};
inline constexpr glm::vec3 kSkylight{0.20F, 0.25F, 0.33F};  // from above, on a level surface
inline constexpr glm::vec3 kHaze{0.66F, 0.76F, 0.87F};      // the colour of distant haze

// Share of light transmitted through distance_m of the lower air. Blue is scattered most.
[[nodiscard]] inline glm::vec3 clear_share(double distance_m) {
  const float d = static_cast<float>(distance_m);
  return {std::exp(-d / 14500.0F), std::exp(-d / 11500.0F), std::exp(-d / 8500.0F)};
}

// The cloudless sky seen along a direction that points up by sine_up (0 level, 1 zenith).
[[nodiscard]] inline glm::vec3 clear_sky(float sine_up) {
  constexpr glm::vec3 kMiddle{0.33F, 0.52F, 0.80F}, kZenith{0.105F, 0.235F, 0.53F};
  const float s = glm::max(sine_up, 0.0F);
  const glm::vec3 low = glm::mix(kMiddle, kHaze, std::exp(-s / 0.085F));
  return glm::mix(low, kZenith, 1 - std::exp(-s / 0.55F));
}

}  // namespace sigs::footage
