// SPDX-License-Identifier: MIT
#include "base/pose.h"

#include <algorithm>
#include <cmath>

namespace sigs {

glm::dquat rotation_of(const Attitude& attitude) {
  const glm::dquat yaw = glm::angleAxis(attitude.yaw_rad, glm::dvec3(0, 0, 1));
  const glm::dquat pitch = glm::angleAxis(attitude.pitch_rad, glm::dvec3(0, 1, 0));
  const glm::dquat roll = glm::angleAxis(attitude.roll_rad, glm::dvec3(1, 0, 0));
  return yaw * pitch * roll;
}

Attitude attitude_of(const glm::dquat& rotation) {
  const glm::dmat3 m = glm::mat3_cast(rotation);  // m[column][row]
  const glm::dvec3 nose = m[0];
  const double pitch_rad = std::asin(std::clamp(-nose.z, -1.0, 1.0));
  const double level = std::hypot(nose.x, nose.y);
  if (level < 1e-9) return {0, pitch_rad, std::atan2(-m[1].x, m[1].y)};
  return {std::atan2(m[1].z, m[2].z), pitch_rad, std::atan2(nose.y, nose.x)};
}

}  // namespace sigs
