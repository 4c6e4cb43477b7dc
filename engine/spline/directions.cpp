// SPDX-License-Identifier: MIT
#include "spline/directions.h"

#include <algorithm>
#include <cmath>

namespace sigs {

double signed_angle(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& axis) {
  return std::atan2(dot(axis, cross(a, b)), dot(a, b));
}

glm::dvec3 turned(const glm::dvec3& v, const glm::dvec3& axis, double angle_rad) {
  return std::cos(angle_rad) * v + std::sin(angle_rad) * cross(axis, v);
}

glm::dvec3 along_arc(const glm::dvec3& from, const glm::dvec3& to, double share) {
  const double angle_rad = angle_between(from, to);
  const double sine = std::sin(angle_rad);
  if (sine < 1e-9) return normalize((1 - share) * from + share * to);  // the chord is the arc
  return normalize((std::sin((1 - share) * angle_rad) * from + std::sin(share * angle_rad) * to) / sine);
}

glm::dvec3 transported(const glm::dvec3& up, const glm::dvec3& from_nose, const glm::dvec3& to_nose) {
  // The rotation about cross(from, to), written without the axis; it has no meaning for a nose turned right about.
  const double one_plus_cosine = std::max(1 + dot(from_nose, to_nose), 1e-12);
  const glm::dvec3 moved = up - dot(up, to_nose) / one_plus_cosine * (from_nose + to_nose);
  return normalize(across(moved, to_nose));
}

}  // namespace sigs
