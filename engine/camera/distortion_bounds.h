// SPDX-License-Identifier: MIT
#pragma once

#include <glm/glm.hpp>

#include "camera/brown_conrady.h"
#include "camera/kannala_brandt.h"

namespace sigs::distortion {

// How strongly a model can bend any straight line within a disk of its undistorted plane. Bounds, not estimates: never
// less than the truth, infinite where nothing is known.
struct DistortionBounds {
  double slope = 0;      // largest |d distorted / d p|
  double curvature = 0;  // largest second derivative of either coordinate along a line, by its length
};

[[nodiscard]] DistortionBounds max_distortion(const BrownConrady& model, const glm::dvec2& center, double radius);
[[nodiscard]] DistortionBounds max_distortion(const KannalaBrandt& model, const glm::dvec2& center, double radius);

}  // namespace sigs::distortion
