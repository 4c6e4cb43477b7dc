// SPDX-License-Identifier: MIT
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "base/result.h"
#include "camera/distortion_models.h"
#include "camera/lens_model.h"

namespace sigs {

// The intrinsics of a camera. Pixels as in base/image.h: the centre of the first pixel is (0, 0).
struct LensParameters {
  LensModel model = LensModel::brown_conrady;
  double fx = 1, fy = 1, cx = 0, cy = 0;  // focal lengths and principal point, px; equirectangular: px per radian
  std::vector<double> coefficients;       // in the model's order

  [[nodiscard]] bool operator==(const LensParameters&) const = default;
};

// Angle from the axis that a lens of this model without distortion shows at a distance from its principal point.
//   distance  in focal lengths
[[nodiscard]] double plain_angle_rad(const LensParameters& lens, double distance);

// Maps directions to pixels and back, as OpenCV's projectPoints and fisheye::projectPoints do, but only within the
// field in which the map is one to one. A direction or pixel beyond it has no image: nothing is extrapolated.
class Lens {
 public:
  // Errors, with an empty place: a number of coefficients that the model does not have; fx or fy not positive; a number
  // that is not finite; a sensor tilted by 90 degrees or more.
  [[nodiscard]] static Result<Lens> make(LensParameters parameters);

  // Pixel of a point given in the camera frame (X along the axis, Y right, Z down; any length). Nothing where the point
  // lies behind the camera (pinhole models), at the camera, or beyond the valid field. Of an equirectangular lens,
  // whose columns repeat every period_px(), the column within half a period of the middle: that of azimuth 0, or of
  // around().
  [[nodiscard]] std::optional<glm::dvec2> pixel(const glm::dvec3& p_in_camera) const;

  // Unit vector in the camera frame along which a pixel looks, by Newton's method with the analytic Jacobian. pixel()
  // of it agrees to 1e-9 px or, far outside any image, to the last digits of doubles.
  // Nothing where no ray within the valid field meets the pixel. Of an equirectangular lens every column has a ray,
  // also beyond the image, and rows beyond a pole show what lies over it, up to the other pole: that pixel() then gives
  // another place.
  [[nodiscard]] std::optional<glm::dvec3> ray(const glm::dvec2& pixel) const;

  // Local magnification: how far the pixel moves, at most, when a direction (camera frame, any length) turns by a small
  // angle; px per radian. It is the largest singular value of d pixel / d angle. 0 where the direction has no image. Of
  // an equirectangular lens it grows without limit towards the poles: within half a pixel of one it is that there.
  [[nodiscard]] double pixels_per_radian(const glm::dvec3& direction_in_camera) const;

  // Largest angle from the optical axis that has an image, radians. The field is round in undistorted coordinates.
  [[nodiscard]] double valid_angle_rad() const;

  // Columns after which the image repeats: 2 pi fx of an equirectangular lens, 0 of any other.
  [[nodiscard]] double period_px() const;

  // The same lens, whose pixel() gives columns within half a period of that of a direction (camera frame, any length),
  // so that the image of what lies around it is in one piece. Of a lens without period the lens itself.
  [[nodiscard]] Lens around(const glm::dvec3& direction_in_camera) const;

  // From one pixel to another, px: the short way round where the image repeats.
  [[nodiscard]] glm::dvec2 way(const glm::dvec2& from_px, const glm::dvec2& to_px) const;

  // True where the lens is a pinhole without distortion: images need no warp.
  [[nodiscard]] bool is_pinhole() const;

  // A lens without distortion that shows what is round the axis as this one does.
  [[nodiscard]] Lens pinhole() const;

  [[nodiscard]] const LensParameters& parameters() const { return parameters_; }

 private:
  Lens(LensParameters parameters, distortion::Model model);

  [[nodiscard]] glm::dvec2 focal() const { return {parameters_.fx, parameters_.fy}; }
  [[nodiscard]] glm::dvec2 center() const { return {parameters_.cx, parameters_.cy}; }
  [[nodiscard]] std::optional<glm::dvec2> plane_point(const glm::dvec3& p_in_camera) const;
  [[nodiscard]] bool comes_back(const glm::dvec3& ray, const glm::dvec2& pixel_px) const;

  LensParameters parameters_;
  distortion::Model model_;
  distortion::Field field_;
  double middle_px_ = 0;  // the column around which pixel() gives columns, of a lens with a period
};

}  // namespace sigs
