// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "camera/lens.h"

namespace sigs {

// The lens models that are fitted, and their projection with derivatives. Points are in OpenCV's optical frame: x
// right, y down, z forward.

// From the simplest to the most flexible.
enum class FitModel {
  pinhole,          // fx fy cx cy
  brown_conrady_5,  // and k1 k2 p1 p2 k3
  kannala_brandt,   // and k1 k2 k3 k4 of the angle
  brown_conrady_8,  // and k1 k2 p1 p2 k3 k4 k5 k6: a quotient of two polynomials
};

// "pinhole", "Brown-Conrady 5", "Kannala-Brandt", "Brown-Conrady 8".
[[nodiscard]] const char* name_of(FitModel model);

// Number of intrinsics with fx fy cx cy: 4, 9, 8, 12.
[[nodiscard]] int intrinsic_count(FitModel model);

constexpr int kMaxIntrinsics = 12;

// fx fy cx cy, then the coefficients in OpenCV's order.
using Intrinsics = Eigen::VectorXd;

[[nodiscard]] LensParameters lens_of(FitModel model, const Intrinsics& intrinsics);

// A pixel and how it moves with the point and with the intrinsics.
struct ProjectedPoint {
  Eigen::Vector2d at_px;
  Eigen::Matrix<double, 2, 3> by_point;
  Eigen::Matrix<double, 2, kMaxIntrinsics> by_intrinsics;  // columns beyond intrinsic_count() are 0
};

// The pixel of a point by the model's formula (OpenCV's projectPoints and fisheye::projectPoints), also beyond the
// field in which it is one to one. Nothing where the formula has no value: behind a pinhole, at the camera, at a
// denominator of 0.
[[nodiscard]] std::optional<ProjectedPoint> projected(FitModel model, const Intrinsics& intrinsics,
                                                      const Eigen::Vector3d& p_in_optical);

// The pixel alone.
[[nodiscard]] std::optional<Eigen::Vector2d> pixel_of(FitModel model, const Intrinsics& intrinsics,
                                                      const Eigen::Vector3d& p_in_optical);

}  // namespace sigs
