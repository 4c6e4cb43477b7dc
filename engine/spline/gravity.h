// SPDX-License-Identifier: MIT
#pragma once

#include <glm/glm.hpp>

#include "spline/motion.h"

namespace sigs {

inline constexpr double kGravity_mps2 = 9.80665;  // standard gravity, ISO 80000-3

// What the wings must bring: acceleration less gravity, in the world (Z down). Upward in level flight.
[[nodiscard]] inline glm::dvec3 specific_force_mps2(const Motion& motion) {
  return motion.acceleration_mps2 - glm::dvec3(0, 0, kGravity_mps2);
}

}  // namespace sigs
