// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <glm/glm.hpp>

namespace sigs::accuracy {

using Real = long double;  // 64 bits of mantissa on x86-64
using Real3 = glm::vec<3, Real>;

// Angle between a direction in double and an exact one, of any lengths; accurate for small angles too.
[[nodiscard]] inline double angle_rad(const glm::dvec3& direction, const Real3& exact) {
  const Real3 d(direction);
  return static_cast<double>(std::atan2(glm::length(glm::cross(d, exact)), glm::dot(d, exact)));
}

}  // namespace sigs::accuracy
