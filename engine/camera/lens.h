// SPDX-License-Identifier: MIT
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <variant>
#include <vector>

#include "base/result.h"
#include "camera/brown_conrady.h"
#include "camera/kannala_brandt.h"
#include "camera/valid_field.h"

namespace sigs {

enum class LensModel {
  brown_conrady,   // OpenCV calib3d: 0, 4, 5, 8, 12 or 14 coefficients k1 k2 p1 p2 k3 k4 k5 k6 s1 s2 s3 s4 tx ty
  kannala_brandt,  // OpenCV fisheye: 4 coefficients k1 k2 k3 k4
};

struct LensParameters {
  LensModel model = LensModel::brown_conrady;
  double fx = 1, fy = 1, cx = 0, cy = 0;  // px
  std::vector<double> coefficients;

  [[nodiscard]] bool operator==(const LensParameters&) const = default;
};

// Maps directions to pixels and back, as OpenCV's projectPoints and fisheye::projectPoints do, but only within the
// field in which the map is one to one. A direction or pixel beyond it has no image, and nothing is extrapolated.
class Lens {
 public:
  // Errors: not a number of coefficients that the model has; fx or fy not positive; anything not finite; a sensor
  // tilted by 90 degrees or more. Where is "".
  [[nodiscard]] static Result<Lens> make(LensParameters parameters);

  // Pixel of a point given in the camera frame (X along the axis, Y right, Z down; any length). Nothing where the point
  // lies behind the camera (pinhole models), at the camera, or beyond the valid field.
  [[nodiscard]] std::optional<glm::dvec2> pixel(const glm::dvec3& p_in_camera) const;

  // Unit ray in the camera frame that a pixel looks along, by Newton's method with the analytic Jacobian, to 1e-9 px
  // (or to the last digits of doubles where a step of theirs is more than that: far outside any image).
  // Nothing where no ray within the valid field meets the pixel.
  [[nodiscard]] std::optional<glm::dvec3> ray(const glm::dvec2& pixel) const;

  // Local magnification: how far the pixel moves, at most, when a direction (camera frame, any length) turns by a small
  // angle; px per radian. The largest singular value of d pixel / d angle. 0 where the direction has no image.
  [[nodiscard]] double pixels_per_radian(const glm::dvec3& direction_in_camera) const;

  // Largest angle from the optical axis that has an image, radians. The field is round in undistorted coordinates.
  [[nodiscard]] double valid_angle_rad() const;

  // True where the lens is a plain pinhole: nothing needs to be warped.
  [[nodiscard]] bool is_pinhole() const;

  [[nodiscard]] const LensParameters& parameters() const { return parameters_; }

 private:
  using Model = std::variant<distortion::BrownConrady, distortion::KannalaBrandt>;
  Lens(LensParameters parameters, Model model);

  [[nodiscard]] glm::dvec2 focal() const { return {parameters_.fx, parameters_.fy}; }
  [[nodiscard]] glm::dvec2 center() const { return {parameters_.cx, parameters_.cy}; }
  [[nodiscard]] std::optional<glm::dvec2> plane_point(const glm::dvec3& p_in_camera) const;
  [[nodiscard]] bool comes_back(const glm::dvec3& ray, const glm::dvec2& pixel_px) const;

  LensParameters parameters_;
  Model model_;
  distortion::Field field_;
};

}  // namespace sigs
