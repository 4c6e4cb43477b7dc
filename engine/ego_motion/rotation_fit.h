// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <optional>
#include <span>
#include <vector>

#include "base/pose.h"

namespace sigs {

// A feature seen in one frame.
struct RayObservation {
  int id = 0;      // the same for the same feature in all frames
  glm::dvec3 ray;  // unit, in camera axes
  double row = 0;  // where it is in the image: -0.5 at the first row, 0 in the middle, 0.5 at the last
};

// All features seen in one frame, by rising id.
using FrameRays = std::vector<RayObservation>;

// How the camera turns while a frame's rows are exposed, about its own axes: t after the middle row it has turned by
// rate t + rate_change t^2 / 2 since then.
struct ReadoutTurn {
  glm::dvec3 rate_radps = glm::dvec3(0);
  glm::dvec3 rate_change_radps2 = glm::dvec3(0);

  [[nodiscard]] glm::dvec3 after(double time_s) const {
    return rate_radps * time_s + rate_change_radps2 * (time_s * time_s / 2);
  }
  ReadoutTurn& operator+=(const ReadoutTurn& more) {
    rate_radps += more.rate_radps;
    rate_change_radps2 += more.rate_change_radps2;
    return *this;
  }
};

// One feature seen in two frames.
struct RayPair {
  glm::dvec3 before;
  glm::dvec3 after;
};

// The features that both frames have.
[[nodiscard]] inline std::vector<RayPair> common_rays(const FrameRays& before, const FrameRays& after) {
  std::vector<RayPair> pairs;
  auto b = after.begin();
  for (const RayObservation& a : before) {
    while (b != after.end() && b->id < a.id) ++b;
    if (b == after.end()) break;
    if (b->id == a.id) pairs.push_back({a.ray, b->ray});
  }
  return pairs;
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
