// SPDX-License-Identifier: MIT
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <span>

#include "camera/increasing_inverse.h"

namespace sigs::distortion {

// The distortion model of OpenCV's calib3d (Brown 1966, Conrady 1919, with the rational, thin prism and tilted sensor
// terms). Works on the image plane at distance 1: p = (x / z, y / z) in OpenCV's optical frame (x right, y down, z
// forward), so that |p| is the tangent of the angle from the axis.
//   u = |p|^2,  N = 1 + k1 u + k2 u^2 + k3 u^3,  D = 1 + k4 u + k5 u^2 + k6 u^3
//   x'' = x N / D + 2 p1 x y + p2 (u + 2 x^2) + s1 u + s2 u^2
//   y'' = y N / D + p1 (u + 2 y^2) + 2 p2 x y + s3 u + s4 u^2
//   w (x''', y''', 1) = tilt (x'', y'', 1)
struct BrownConrady {
  double k1 = 0, k2 = 0, k3 = 0, k4 = 0, k5 = 0, k6 = 0;
  double p1 = 0, p2 = 0;
  double s1 = 0, s2 = 0, s3 = 0, s4 = 0;
  glm::dmat3 tilt{1};
  glm::dmat3 tilt_inverse{1};
  bool radial_only = true;  // neither p nor s: a circle around the axis stays one, before the tilt
  bool tilted = false;

  // In OpenCV's order k1 k2 p1 p2 k3 k4 k5 k6 s1 s2 s3 s4 tau_x tau_y; those not given are zero.
  [[nodiscard]] static BrownConrady of(std::span<const double> coefficients);

  // Everything but the tilt: (x'', y''), and its derivative (column i: by p[i]).
  [[nodiscard]] glm::dvec2 distorted_before_tilt(const glm::dvec2& p) const;
  [[nodiscard]] glm::dmat2 jacobian_before_tilt(const glm::dvec2& p) const;

  // The radial part alone, at |p| = r: r N / D and its derivative by r.
  [[nodiscard]] ValueAndSlope radial(double r) const;

  // The whole model: (x''', y'''), and its derivative.
  [[nodiscard]] glm::dvec2 distorted(const glm::dvec2& p) const;
  [[nodiscard]] glm::dmat2 jacobian(const glm::dvec2& p) const;

  // (x'', y'') of (x''', y'''). Nothing where that lies on the far side of the tilted sensor's horizon.
  [[nodiscard]] std::optional<glm::dvec2> untilted(const glm::dvec2& distorted_point) const;

  // Between directions in the optical frame and the plane. Nothing where the point is not in front of the camera.
  [[nodiscard]] static std::optional<glm::dvec2> plane_of(const glm::dvec3& p_optical);
  [[nodiscard]] static glm::dvec3 ray_of(const glm::dvec2& p);

  // Motion on the plane per radian that the direction turns: along the radius (x) and across it (y).
  [[nodiscard]] static glm::dvec2 stretch(const glm::dvec2& p);
};

}  // namespace sigs::distortion
