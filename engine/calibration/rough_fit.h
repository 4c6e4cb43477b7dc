// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <functional>
#include <string>
#include <vector>

#include "calibration/rough_lens.h"

namespace sigs {

// What is believed of the distortion before anything is looked at: lenses from a pinhole to an action camera's.
struct DistortionPrior {
  double mean = -0.05;
  double sd = 0.15;
};

// A lens found, and how certain it is.
struct RoughFit {
  RoughLens lens;
  double distortion_sd = 0;
  double field_low_rad = 0;  // of the horizontal field of view; with 95 % it lies between them
  double field_high_rad = 0;
  int parts = 0;           // of the footage that were taken as independent of each other
  double residual_px = 0;  // median miss of what was fitted

  // Half of the interval over the field itself, of the focal length: 0.05 means 5 %.
  [[nodiscard]] double relative_uncertainty() const;
};

// A fit, or the reason why there is none, for people: "the camera turns too little".
struct RoughAnswer {
  std::optional<RoughFit> fit;
  std::string reason;
};

// Sums of weighted least squares over one part of the data: normal matrix and right side at the solution.
struct PartSums {
  Eigen::MatrixXd normal;
  Eigen::VectorXd right;
};

// Covariance of the solution from how much the parts disagree: (sum N)^-1 (sum g g') (sum N)^-1, which holds whatever
// the errors within one part have in common (Liang, Zeger 1986). `known` is a prior's normal matrix.
[[nodiscard]] Eigen::MatrixXd clustered_covariance(const std::vector<PartSums>& parts, const Eigen::MatrixXd& known);

// The value that Student's t of so many degrees of freedom exceeds in absolute value with 5 %.
[[nodiscard]] double student_95(int degrees);

// The lens of some parameters, of which the first two are the focal length's and the distortion.
using LensOf = std::function<RoughLens(const Eigen::VectorXd&)>;

// The fit with limits of the field: how far it moves along the axes of the covariance, times t of the parts.
//   least_relative  standard deviation of the focal length that no data can take away, 0.01: 1 %
[[nodiscard]] RoughFit fit_of(const LensOf& lens_of, const Eigen::VectorXd& found, const Eigen::MatrixXd& covariance,
                              int parts, double least_relative);

// Weight by Geman and McClure of a miss, and the scale for it: the median length of the misses, but no less than
// least_px.
[[nodiscard]] inline double weight_of(double miss2, double scale) {
  const double share = 1 + miss2 / (scale * scale);
  return 1 / (share * share);
}
[[nodiscard]] double scale_of(std::vector<double> lengths, double least_px);

}  // namespace sigs
