// SPDX-License-Identifier: MIT
#pragma once

#include <glm/glm.hpp>

namespace sigs {

// Where something is and how it moves, in the world, at one moment.
struct Motion {
  glm::dvec3 position_m{0, 0, 0};
  glm::dvec3 velocity_mps{0, 0, 0};
  glm::dvec3 acceleration_mps2{0, 0, 0};
};

}  // namespace sigs
