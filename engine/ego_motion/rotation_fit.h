// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <span>

#include "ego_motion/tracks.h"

namespace sigs {

struct RotationFitSettings {
  double inlier_rad = 0.003;  // a pair that agrees misses by no more
  int min_inliers = 12;
  double min_share = 0.3;  // of all pairs that have to agree
};

struct RotationFit {
  Eigen::Quaterniond after_from_before;  // takes rays of the first frame to those of the second
  Eigen::Matrix3d covariance;            // of small turns about the second frame's axes, rad^2
  double sigma_rad = 0;                  // of one pair in each direction, from the pairs that agree
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
[[nodiscard]] Eigen::Quaterniond best_rotation(std::span<const RayPair> pairs, std::span<const double> weights);

}  // namespace sigs
