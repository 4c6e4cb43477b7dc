// SPDX-License-Identifier: MIT
#pragma once

#include <glm/glm.hpp>
#include <limits>
#include <vector>

#include "camera/distortion_models.h"

namespace sigs::distortion {

// The disk of a model's undistorted plane on which the model is one to one.
struct Field {
  // |p| < radius: a tangent (Brown-Conrady) or an angle in radians (on the equidistant plane), as in the model's plane.
  double radius = std::numeric_limits<double>::infinity();
  // Image of the disk's rim before the tilt: a closed polygon, its corners in order. Empty for models that keep
  // circles.
  std::vector<glm::dvec2> edge;
};

// Brown-Conrady: up to the first radius at which, anywhere on the circle,
//   - the radial part stops increasing, or the determinant of the Jacobian stops being positive (a fold), or
//   - the rational denominator falls to 1e-6, or the ray runs parallel to a tilted sensor.
// Where the determinant is positive on a disk, each circle in it is distorted to c e^{i phi} + d e^{2 i phi} + offset
// with |c| > 2 |d|, a curve that does not cross itself; so the map is one to one on the whole disk, not only locally.
// Without distortion there is no limit; with any, |p| stays below 1e8 (6e-7 degrees short of 90).
[[nodiscard]] Field valid_field(const BrownConrady& model);

// Kannala-Brandt: up to the first angle at which the distorted radius stops increasing, at most pi.
[[nodiscard]] Field valid_field(const KannalaBrandt& model);

}  // namespace sigs::distortion
