// SPDX-License-Identifier: MIT
#pragma once

#include <glm/glm.hpp>

namespace sigs {

// The intruder as the camera's position has it: its position less the camera's, in world axes. Both fly straight at
// constant velocity, so this is a straight line too.
struct RelativeMotion {
  glm::dvec3 start_m{0, 0, 0};  // at the video's first frame
  glm::dvec3 velocity_mps{0, 0, 0};

  [[nodiscard]] glm::dvec3 at(double since_first_s) const { return start_m + since_first_s * velocity_mps; }
};

// Least distance between the first frame and `length_s` after it.
[[nodiscard]] double min_range_m(const RelativeMotion& motion, double length_s);

}  // namespace sigs
