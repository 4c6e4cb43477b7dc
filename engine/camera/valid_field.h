// SPDX-License-Identifier: MIT
#pragma once

#include <glm/glm.hpp>
#include <limits>
#include <vector>

#include "camera/brown_conrady.h"
#include "camera/kannala_brandt.h"

namespace sigs::distortion {

// The disk of the undistorted plane on which a lens is one to one.
struct Field {
  double radius =
      std::numeric_limits<double>::infinity();  // |p| < radius; a tangent or an angle, as the model's plane is
  std::vector<glm::dvec2>
      edge;  // where the model distorts its rim to (before the tilt), in order round it; may be empty
};

// Brown-Conrady: up to the first radius at which, anywhere round the circle,
//   - the radial part stops growing, or the determinant of the Jacobian stops being positive (a fold), or
//   - the rational denominator comes down to 1e-6 or a tilted sensor is met edge on.
// Where the determinant is positive on a disk, each circle in it is bent to c e^{i phi} + d e^{2 i phi} + offset with
// |c| > 2 |d|, a curve that does not cross itself; so the map is one to one on the disk as a whole, not just locally.
// Without distortion there is no limit; with any, |p| stays below 1e8 (6e-7 degrees short of 90).
[[nodiscard]] Field valid_field(const BrownConrady& model);

// Kannala-Brandt: up to the first angle at which the distorted radius stops growing, at most pi.
[[nodiscard]] Field valid_field(const KannalaBrandt& model);

}  // namespace sigs::distortion
