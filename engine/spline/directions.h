// SPDX-License-Identifier: MIT
#pragma once

#include <glm/glm.hpp>

#include "base/pose.h"
#include "spline/piecewise_cubic.h"

namespace sigs {

// Geometry of directions, and gravity. All angles are in radians, all vectors in the world (Z down). angle_between() is
// in base/pose.h.

inline constexpr glm::dvec3 kWorldUp{0, 0, -1};

// The part of v that is perpendicular to a unit direction.
[[nodiscard]] inline glm::dvec3 across(const glm::dvec3& v, const glm::dvec3& direction) {
  return v - dot(v, direction) * direction;
}

// The angle about a unit axis that rotates a into b, by the right-hand rule, -pi..pi. a and b are perpendicular to the
// axis.
[[nodiscard]] double signed_angle(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& axis);

// v rotated about a unit axis perpendicular to it, by the right-hand rule.
[[nodiscard]] glm::dvec3 turned(const glm::dvec3& v, const glm::dvec3& axis, double angle_rad);

// The point on the great circle between two unit vectors; share runs from 0 (from) to 1 (to). The two vectors must not
// be opposite.
[[nodiscard]] glm::dvec3 along_arc(const glm::dvec3& from, const glm::dvec3& to, double share);

// An up vector carried along while the nose turns the shortest way from one direction to another (parallel transport on
// the sphere). The result is a unit vector perpendicular to the new nose; `up` is perpendicular to the old one.
[[nodiscard]] glm::dvec3 transported(const glm::dvec3& up, const glm::dvec3& from_nose, const glm::dvec3& to_nose);

inline constexpr double kGravity_mps2 = 9.80665;  // standard gravity, ISO 80000-3

// Specific force, the acceleration that the wings have to provide: acceleration less gravity. Points up in level
// flight.
[[nodiscard]] inline glm::dvec3 specific_force_mps2(const Motion& motion) {
  return motion.acceleration_mps2 - glm::dvec3(0, 0, kGravity_mps2);
}

}  // namespace sigs
