// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "base/result.h"

namespace sigs {

enum class LensModel {
  brown_conrady,   // OpenCV calib3d: 0, 4, 5, 8, 12 or 14 coefficients k1 k2 p1 p2 k3 k4 k5 k6 s1 s2 s3 s4 tx ty
  kannala_brandt,  // OpenCV fisheye: 4 coefficients k1 k2 k3 k4
};

struct LensParameters {
  LensModel model = LensModel::brown_conrady;
  double fx = 1, fy = 1, cx = 0, cy = 0;  // px
  std::vector<double> coefficients;
};

// Maps directions to pixels and back, as OpenCV's projectPoints and fisheye::projectPoints do, but only within the field
// in which the map is one to one. A direction or pixel beyond it has no image, and nothing is extrapolated.
class Lens {
 public:
  // Errors: not a number of coefficients that the model has; fx or fy not positive; anything not finite. Where is "".
  [[nodiscard]] static Result<Lens> make(LensParameters parameters);

  // Pixel of a point given in the camera frame (X along the axis, Y right, Z down; any length). Nothing where the point
  // lies behind the camera (pinhole models), at the camera, or beyond the valid field.
  [[nodiscard]] std::optional<glm::dvec2> pixel(const glm::dvec3& p_in_camera) const;

  // Unit ray in the camera frame that a pixel looks along, by Newton's method with the analytic Jacobian, to 1e-9 px.
  // Nothing where no ray within the valid field meets the pixel.
  [[nodiscard]] std::optional<glm::dvec3> ray(const glm::dvec2& pixel) const;

  // Largest angle from the optical axis that has an image, radians. The field is round in undistorted coordinates.
  [[nodiscard]] double valid_angle_rad() const;

  // True where the lens is a plain pinhole: nothing needs to be bent.
  [[nodiscard]] bool is_pinhole() const;

  [[nodiscard]] const LensParameters& parameters() const { return parameters_; }

 private:
  explicit Lens(LensParameters parameters);
  LensParameters parameters_;
};

}  // namespace sigs
