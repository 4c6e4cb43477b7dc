// SPDX-License-Identifier: MIT
#include "base/pose.h"

#include <cmath>
#include <numbers>

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
  const double level = std::hypot(nose.x, nose.y);
  const double pitch_rad = std::atan2(-nose.z, level);
  if (level < 1e-12) return {0, pitch_rad, std::atan2(-m[1].x, m[1].y)};
  // The roll is what yaw and pitch leave, so that near the vertical, where rounding turns the yaw, the product of the
  // three stays the rotation.
  const double yaw_rad = std::atan2(nose.y, nose.x);
  const glm::dquat rest = glm::conjugate(rotation_of({0, pitch_rad, yaw_rad})) * rotation;
  return {std::remainder(2 * std::atan2(rest.x, rest.w), 2 * std::numbers::pi), pitch_rad, yaw_rad};
}

}  // namespace sigs
