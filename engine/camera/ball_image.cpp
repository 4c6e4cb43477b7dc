// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <limits>

#include "base/pose.h"
#include "camera/distortion_bounds.h"
#include "camera/lens.h"

namespace sigs {

namespace {

constexpr double kTight = 1e-9;  // a share by which bounds stay clear of the field's rim

// As BallImage, before focal length and centre: optical frame, distorted plane.
struct PlaneImage {
  bool none_has_image = false;
  bool all_have_image = false;
  glm::dvec3 along{0};
  std::array<glm::dvec3, 2> across{};
  double error = 0;
  double steepest = 0;  // largest change of the place on the plane, by the ball's directions
};

// On a plane that is itself a projection the tangent there is one: nothing but the lens' own bend is left over.
PlaneImage image_of(const distortion::BrownConrady& model, double field, const glm::dvec3& center, double radius) {
  const double least = kTight * 1e-3 * (glm::length(center) + radius);
  if (center.z + radius < -least) return {.none_has_image = true};
  if (!(center.z - radius > least)) return {};
  const glm::dvec2 middle = glm::dvec2(center) / center.z;
  const double off_axis = glm::length(middle);
  // (c + d) / (z + dz) - c / z = (d - dz c / z) / (z + dz)
  const double reach = radius * std::hypot(1.0, off_axis) / (center.z - radius);
  if (off_axis - reach > field * (1 + kTight)) return {.none_has_image = true};
  if (!(off_axis + reach < field * (1 - kTight))) return {};
  const distortion::DistortionBounds limits = distortion::max_distortion(model, middle, reach);
  if (!std::isfinite(limits.curvature)) return {};
  const glm::dvec2 at = model.distorted(middle);
  const glm::dmat2 jacobian = model.jacobian(middle);
  const glm::dvec2 foot = at - jacobian * middle;
  return {
      .all_have_image = true,
      .along = {0, 0, 1},
      .across = {glm::dvec3(jacobian[0].x, jacobian[1].x, foot.x), glm::dvec3(jacobian[0].y, jacobian[1].y, foot.y)},
      .error = limits.curvature * reach * reach / 2,
      .steepest = limits.slope * (1 + off_axis + reach)};
}

// theta / sin(theta) as a function of c = cos(theta), and its derivatives' magnitudes, at an angle or any smaller one:
// it is the integral of dt / (t^2 + 2 c t + 1) over t > 0, so that all of them fall as c grows.
struct Spread {
  double value = 0;
  double slope = 0;
  double curvature = 0;
};

Spread largest_spread(double theta_rad) {
  constexpr double kSmallest_rad = 0.5;  // below, differences would cancel
  const double theta = std::max(theta_rad, kSmallest_rad);
  const double c = std::cos(theta);
  const double s = std::sin(theta);
  const double value = theta / s;
  const double slope = (c * value - 1) / (s * s);
  return {value, std::abs(slope), std::abs(value + 3 * c * slope) / (s * s)};
}

// Round a projection's plane of the ball's own, perpendicular to its direction. With n(a) the directions along a great
// circle, a place on the lens' plane is p = n_xy f(n_z), f the spread above; |n_xy| and |n_z'| are at most the sine s
// of the angle from the axis, n'' is -n, so that
//   |p'| <= f   and   |p''| <= s f + 2 s |f'| + s^3 f'' + s |f'|
// By the tangent t of the angle a, d2/dt2 = cos^4 a d2/da2 - 2 sin a cos^3 a d/da.
PlaneImage image_of(const distortion::KannalaBrandt& model, double field, const glm::dvec3& center, double radius) {
  constexpr double kFarthest_rad = 3.1;  // nothing is smooth about the direction straight back
  const double distance = glm::length(center);
  if (!(distance > radius * (1 + kTight))) return {};
  const double half_angle = std::asin(radius / distance);
  const double reach = std::tan(half_angle);
  const double off_axis = std::hypot(center.x, center.y);
  const double theta = std::atan2(off_axis, center.z);
  if (theta - half_angle > field * (1 + kTight)) return {.none_has_image = true};
  const double farthest = theta + half_angle;
  if (!(farthest < std::min(field * (1 - kTight), kFarthest_rad))) return {};
  const glm::dvec2 outward = off_axis > 0 ? glm::dvec2(center) / off_axis : glm::dvec2(1, 0);
  const glm::dvec2 around{-outward.y, outward.x};
  const glm::dvec2 middle = outward * theta;
  const Spread spread = largest_spread(farthest);
  const distortion::DistortionBounds limits = distortion::max_distortion(model, middle, spread.value * half_angle);
  if (!std::isfinite(limits.curvature)) return {};
  const double s = farthest < 1.5 ? std::sin(farthest) : 1;
  const double curvature = s * (spread.value + 3 * spread.slope + s * s * spread.curvature);
  const glm::dmat2 jacobian = model.jacobian(middle);
  const glm::dvec2 by_outward = jacobian * outward;
  const glm::dvec2 by_around = jacobian * around * model.stretch(middle).y;
  const glm::dvec3 direction = center / distance;
  const glm::dvec3 turned_outward(outward * std::cos(theta), -std::sin(theta));
  const glm::dvec3 turned_around(around, 0);
  const glm::dvec2 at = model.distorted(middle);
  PlaneImage image{.all_have_image = true, .along = direction};
  for (int i = 0; i < 2; ++i)
    image.across[static_cast<std::size_t>(i)] =
        by_outward[i] * turned_outward + by_around[i] * turned_around + at[i] * direction;
  image.error =
      (limits.curvature * spread.value * spread.value + limits.slope * (curvature + 2 * reach * spread.value)) * reach *
      reach / 2;
  image.steepest = limits.slope * spread.value * (1 + reach);
  return image;
}

}  // namespace

BallImage Lens::ball_image(const glm::dvec3& center_in_camera, double radius) const {
  constexpr double kRounding = 1e-12;  // some thousand steps of doubles
  const PlaneImage plane = std::visit(
      [&](const auto& model) { return image_of(model, field_.radius, optical_of(center_in_camera), radius); }, model_);
  BallImage image{.none_has_image = plane.none_has_image, .all_have_image = plane.all_have_image};
  if (!image.all_have_image) return image;
  image.along = camera_of(plane.along);
  for (int i = 0; i < 2; ++i) {
    const auto n = static_cast<std::size_t>(i);
    image.across[n] = camera_of(focal()[i] * plane.across[n] + center()[i] * plane.along);
  }
  const double focal_px = std::max(parameters_.fx, parameters_.fy);
  const double magnitude_px = focal_px * plane.steepest + std::abs(parameters_.cx) + std::abs(parameters_.cy);
  image.error_px = focal_px * plane.error + kRounding * magnitude_px;
  if (!std::isfinite(image.error_px)) return {};
  return image;
}

}  // namespace sigs
