// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>

namespace sigs {

// Rotations as rotation vectors (axis times angle, radians) and back, and the change between the matrix libraries.
// Murray, Li, Sastry: A Mathematical Introduction to Robotic Manipulation, section 2.2.

// The rotation by |vector_rad| about the direction of the vector.
[[nodiscard]] inline Eigen::Quaterniond turn_of(const Eigen::Vector3d& vector_rad) {
  const double angle_rad = vector_rad.norm();
  if (angle_rad < 1e-12) return Eigen::Quaterniond(1, vector_rad.x() / 2, vector_rad.y() / 2, vector_rad.z() / 2);
  return Eigen::Quaterniond(Eigen::AngleAxisd(angle_rad, vector_rad / angle_rad));
}

// The rotation vector of a unit quaternion; its length is 0..pi.
[[nodiscard]] inline Eigen::Vector3d vector_of(const Eigen::Quaterniond& turn) {
  const double sine = turn.vec().norm();
  const double sign = turn.w() < 0 ? -1 : 1;
  if (sine < 1e-12) return 2 * sign * turn.vec();
  return turn.vec() * (2 * sign * std::atan2(sine, std::abs(turn.w())) / sine);
}

// The matrix of the cross product: cross_matrix(a) * b = a x b.
[[nodiscard]] inline Eigen::Matrix3d cross_matrix(const Eigen::Vector3d& a) {
  Eigen::Matrix3d m;
  m << 0, -a.z(), a.y(), a.z(), 0, -a.x(), -a.y(), a.x(), 0;
  return m;
}

// Two unit vectors that span the plane orthogonal to a unit vector, as columns.
[[nodiscard]] inline Eigen::Matrix<double, 3, 2> tangents_of(const Eigen::Vector3d& direction) {
  const Eigen::Vector3d helper = std::abs(direction.x()) < 0.6 ? Eigen::Vector3d::UnitX() : Eigen::Vector3d::UnitY();
  Eigen::Matrix<double, 3, 2> basis;
  basis.col(0) = direction.cross(helper).normalized();
  basis.col(1) = direction.cross(basis.col(0));
  return basis;
}

[[nodiscard]] inline Eigen::Vector3d eigen_of(const glm::dvec3& v) {
  return {v.x, v.y, v.z};
}
[[nodiscard]] inline glm::dvec3 glm_of(const Eigen::Vector3d& v) {
  return {v.x(), v.y(), v.z()};
}
[[nodiscard]] inline Eigen::Quaterniond eigen_of(const glm::dquat& q) {
  return {q.w, q.x, q.y, q.z};
}
[[nodiscard]] inline glm::dquat glm_of(const Eigen::Quaterniond& q) {
  return {q.w(), q.x(), q.y(), q.z()};
}

}  // namespace sigs
