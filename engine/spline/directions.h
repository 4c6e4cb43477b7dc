// SPDX-License-Identifier: MIT
#pragma once

#include <glm/glm.hpp>

namespace sigs {

// Geometry of unit vectors. All angles in radians, all vectors in the world (Z down).

inline constexpr glm::dvec3 kWorldUp{0, 0, -1};

// What is left of v across a unit direction.
[[nodiscard]] inline glm::dvec3 across(const glm::dvec3& v, const glm::dvec3& direction) {
  return v - dot(v, direction) * direction;
}

// Angle between two vectors of any length, 0..pi; good for the smallest angles too. 0 where one of them is zero.
[[nodiscard]] double angle_between(const glm::dvec3& a, const glm::dvec3& b);

// Angle that turns a into b about a unit axis across both, by the right-hand rule, -pi..pi.
[[nodiscard]] double signed_angle(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& axis);

// v turned about a unit axis across it, by the right-hand rule.
[[nodiscard]] glm::dvec3 turned(const glm::dvec3& v, const glm::dvec3& axis, double angle_rad);

// The point of the great circle from one unit vector to another at share 0..1 of the way. The two are not opposite.
[[nodiscard]] glm::dvec3 along_arc(const glm::dvec3& from, const glm::dvec3& to, double share);

// An up vector taken along when the nose turns from one direction to another the shortest way (parallel transport on
// the sphere): across the new nose, unit. up is across the old nose.
[[nodiscard]] glm::dvec3 transported(const glm::dvec3& up, const glm::dvec3& from_nose, const glm::dvec3& to_nose);

}  // namespace sigs
