// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <optional>
#include <span>

#include "ego_motion/tracks.h"

namespace sigs {

// Rotations as rotation vectors (axis times angle, radians) and back.
// Murray, Li, Sastry: A Mathematical Introduction to Robotic Manipulation, section 2.2.

// The rotation by |vector_rad| about the direction of the vector.
[[nodiscard]] inline glm::dquat turn_of(const glm::dvec3& vector_rad) {
  const double angle_rad = glm::length(vector_rad);
  if (angle_rad < 1e-12) return {1, vector_rad.x / 2, vector_rad.y / 2, vector_rad.z / 2};
  return glm::angleAxis(angle_rad, vector_rad / angle_rad);
}

// The rotation vector of a unit quaternion; its length is 0..pi.
[[nodiscard]] inline glm::dvec3 vector_of(const glm::dquat& turn) {
  const glm::dvec3 along(turn.x, turn.y, turn.z);
  const double sine = glm::length(along);
  const double sign = turn.w < 0 ? -1 : 1;
  if (sine < 1e-12) return 2 * sign * along;
  return along * (2 * sign * std::atan2(sine, std::abs(turn.w)) / sine);
}

// The matrix of the cross product: cross_matrix(a) * b = a x b.
[[nodiscard]] inline glm::dmat3 cross_matrix(const glm::dvec3& a) {
  return {0, a.z, -a.y, -a.z, 0, a.x, a.y, -a.x, 0};
}

// Two unit vectors that span the plane orthogonal to a unit vector.
[[nodiscard]] inline glm::dmat2x3 tangents_of(const glm::dvec3& direction) {
  const glm::dvec3 helper = std::abs(direction.x) < 0.6 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
  const glm::dvec3 first = glm::normalize(glm::cross(direction, helper));
  return {first, glm::cross(direction, first)};
}

struct RotationFitSettings {
  double inlier_rad = 0.003;  // a pair that agrees misses by no more
  int min_inliers = 12;
  double min_share = 0.3;  // of all pairs that have to agree
};

struct RotationFit {
  glm::dquat after_from_before;  // takes rays of the first frame to those of the second
  glm::dmat3 covariance;         // of small turns about the second frame's axes, rad^2
  double sigma_rad = 0;          // of one pair in each direction, from the pairs that agree
  int inliers = 0;
};

// The rotation with which most of the pairs agree, of directions to points far away; pairs that move on their own, up
// to about half, are left out. Rotations of two pairs each are tried (Fischler, Bolles 1981, with a fixed sequence of
// numbers), then the one that most agree with is fitted by reweighted least squares with Tukey's weights.
// Nothing where fewer than min_inliers agree, or all rays are nearly the same direction, about which they tell nothing.
// Pairs that are not finite are left out.
[[nodiscard]] std::optional<RotationFit> fitted_rotation(std::span<const RayPair> pairs,
                                                         const RotationFitSettings& settings);

// The rotation that takes the unit vectors `before` to `after` with the least sum of squares (Wahba 1965; Horn 1987, by
// the largest eigenvalue of a 4x4 matrix). weights: one for each pair, 0 or more. Two directions or more are needed.
[[nodiscard]] glm::dquat best_rotation(std::span<const RayPair> pairs, std::span<const double> weights);

}  // namespace sigs
