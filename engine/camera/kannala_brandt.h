// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <optional>
#include <span>

#include "camera/increasing_inverse.h"

namespace sigs::distortion {

// The fisheye model of OpenCV (Kannala and Brandt 2006, equation 6 without the asymmetric terms). Works on the
// equidistant plane: p points from the axis towards the direction and its length is the angle theta from the axis, so
// directions beside and behind the camera have a place too.
//   distorted = p (1 + k1 theta^2 + k2 theta^4 + k3 theta^6 + k4 theta^8)
struct KannalaBrandt {
  std::array<double, 4> k{};

  [[nodiscard]] static KannalaBrandt of(std::span<const double> coefficients);

  [[nodiscard]] ValueAndSlope radial(double theta_rad) const;
  [[nodiscard]] glm::dvec2 distorted(const glm::dvec2& p) const;
  [[nodiscard]] glm::dmat2 jacobian(const glm::dvec2& p) const;  // column i: by p[i]

  // Between directions in OpenCV's optical frame (x right, y down, z forward) and the plane. Nothing for the camera's
  // own place and for what lies exactly behind it, which is everywhere on the rim at once.
  [[nodiscard]] static std::optional<glm::dvec2> plane_of(const glm::dvec3& p_optical);
  [[nodiscard]] static glm::dvec3 ray_of(const glm::dvec2& p);

  // Motion on the plane per radian that the direction turns: along the radius (x) and across it (y).
  [[nodiscard]] static glm::dvec2 stretch(const glm::dvec2& p);
};

}  // namespace sigs::distortion
