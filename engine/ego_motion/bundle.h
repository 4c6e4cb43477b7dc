// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "ego_motion/settings.h"

namespace sigs {

// Adjustment of key frames and landmarks together, so that near ground, which moves by parallax, and far points tell of
// the rotation what they know each: Triggs et al., Bundle Adjustment - A Modern Synthesis (1999). Landmarks have an
// inverse depth (Montiel, Civera, Davison 2006), which is 0 for points too far for any parallax.
//
// The unit of length is what the camera flies in one second on average: nothing in the images tells the true scale.

struct BundleFrame {
  Eigen::Quaterniond world_from_camera = Eigen::Quaterniond::Identity();
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  double time_s = 0;
};

// The point reference + direction / inverse_depth.
struct Landmark {
  Eigen::Vector3d reference = Eigen::Vector3d::Zero();   // fixed
  Eigen::Vector3d direction = Eigen::Vector3d::UnitX();  // unit
  double inverse_depth = 0;
  double weight = 1;  // 0..1: how far its observations agree with each other; set by adjust()
  double trust = 1;   // 0..1: how far it is known beforehand to stand still
};

struct BundleObservation {
  int frame = 0;
  int landmark = 0;
  Eigen::Vector3d ray;  // unit, camera axes
};

struct Bundle {
  std::vector<BundleFrame> frames;  // the first is held
  std::vector<Landmark> landmarks;
  std::vector<BundleObservation> observations;  // by rising landmark
};

struct BundleSettings {
  double least_sigma_rad = 1e-5;  // of an observation
  double least_scale_rad = 1e-4;  // of weights: what agrees as well as this is not distinguished, see adjust()
  double start_sigma_rad = 2e-3;  // the first round takes no observation for wrong that misses by less
  double inverse_depth_sd = 0.3;  // what is expected of landmarks beforehand, per unit of length
  double acceleration_sd = 0.3;   // change of velocity in a second, units per second
  int rounds = 12;
};

struct BundleFit {
  std::vector<Eigen::Matrix3d> covariances;  // of each frame's rotation against the first: small turns about the
                                             // camera's axes, rad^2
  double sigma_rad = 0;                      // of an observation in one direction
};

// Least squares with weights of Geman and McClure, of single observations and of whole landmarks, whose scale shrinks
// from round to round (graduated non-convexity): what moves on its own loses its weight. Changes frames and landmarks.
// The scale does not fall below least_scale_rad, lest the few that agree best by chance, among many that are as good,
// take all the weight. Landmarks that are not trusted count for as much less, and nothing for the scale.
[[nodiscard]] BundleFit adjust(Bundle& bundle, const BundleSettings& settings, CancelFlag cancel = nullptr);

// How far a camera's small turn and small motion, and a landmark's, move a point's image on the unit sphere.
struct Projection {
  Eigen::Vector2d residual;                 // seen less predicted, in the tangent plane of the ray
  Eigen::Matrix<double, 2, 6> by_frame;     // of the prediction by (turn about the camera's axes, position)
  Eigen::Matrix<double, 2, 3> by_landmark;  // by (two tangents of the direction, inverse depth)
};
[[nodiscard]] Projection projection(const BundleFrame& frame, const Landmark& landmark, const Eigen::Vector3d& ray);

}  // namespace sigs
