// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <opencv2/core/types.hpp>
#include <optional>

#include "base/result.h"
#include "camera/lens.h"

namespace sigs {

// A lens of two numbers, as much as footage of no board shows: the focal length, and a distortion that grows with the
// square of the distance from the image's centre. It is the division model (Fitzgibbon 2001, "Simultaneous linear
// estimation of multiple view geometry and lens distortion"): a pixel at the distance r from the centre shows what a
// pinhole of the same focal length has at the distance
//   r / (1 + distortion (r / radius)^2)
// where `radius` is half of the image's diagonal. 0: a pinhole. Below 0: barrel. With
// distortion = -(radius / (2 focal))^2 it is the stereographic fisheye exactly; both directions have a closed form.
struct RoughLens {
  cv::Size size_px;
  double focal_px = 1;    // also px per radian at the image's centre
  double distortion = 0;  // without unit; above -1

  // (X forward, Y right, Z down); not of unit length. A pixel of the lens' own, as in base/image.h.
  [[nodiscard]] Eigen::Vector3d ray(const Eigen::Vector2d& pixel) const;

  // The pixel of a direction of any length; nothing where none shows it.
  [[nodiscard]] std::optional<Eigen::Vector2d> pixel(const Eigen::Vector3d& direction) const;

  [[nodiscard]] double radius_px() const;

  // Angle between the middles of the left and the right border, radians; 0 to 2 pi.
  [[nodiscard]] double horizontal_field_rad() const;
};

// The lens whose image is `field_rad` wide, between 0 and 2 pi, with this distortion. Nothing where there is none.
[[nodiscard]] std::optional<RoughLens> rough_lens_of_field(cv::Size size_px, double field_rad, double distortion);

// The same lens in a model of OpenCV's: Brown-Conrady with k1, k2 and k3 fitted to it by least squares where that
// follows it to 0.2 px over the whole image, else Kannala-Brandt with its four coefficients.
// Error bad_data where neither has the image's corners in its valid field.
[[nodiscard]] Result<LensParameters> parameters_of(const RoughLens& lens);

}  // namespace sigs
