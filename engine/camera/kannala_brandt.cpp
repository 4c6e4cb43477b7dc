// SPDX-License-Identifier: MIT
#include "camera/kannala_brandt.h"

#include <cmath>

namespace sigs::distortion {
namespace {

// sin(t) / t, whole at zero: below the limit the next term of the series, t^4 / 120, is under the last bit.
double sine_over(double t) {
  constexpr double kSeriesBelow = 1e-4;
  return t < kSeriesBelow ? 1 - t * t / 6 : std::sin(t) / t;
}

}  // namespace

KannalaBrandt KannalaBrandt::of(std::span<const double> coefficients) {
  KannalaBrandt model;
  for (std::size_t i = 0; i < coefficients.size() && i < model.k.size(); ++i) model.k[i] = coefficients[i];
  return model;
}

ValueAndSlope KannalaBrandt::radial(double theta_rad) const {
  const double u = theta_rad * theta_rad;
  return {theta_rad * (1 + u * (k[0] + u * (k[1] + u * (k[2] + u * k[3])))),
          1 + u * (3 * k[0] + u * (5 * k[1] + u * (7 * k[2] + u * 9 * k[3])))};
}

glm::dvec2 KannalaBrandt::distorted(const glm::dvec2& p) const {
  const double u = glm::dot(p, p);
  return p * (1 + u * (k[0] + u * (k[1] + u * (k[2] + u * k[3]))));
}

glm::dmat2 KannalaBrandt::jacobian(const glm::dvec2& p) const {
  const double u = glm::dot(p, p);
  const double factor = 1 + u * (k[0] + u * (k[1] + u * (k[2] + u * k[3])));
  const double slope = k[0] + u * (2 * k[1] + u * (3 * k[2] + u * 4 * k[3]));  // of the factor, by u
  return factor * glm::dmat2{1} + 2 * slope * glm::outerProduct(p, p);
}

std::optional<glm::dvec2> KannalaBrandt::plane_of(const glm::dvec3& p_optical) {
  const double off_axis = std::hypot(p_optical.x, p_optical.y);
  if (off_axis == 0) return p_optical.z > 0 ? std::optional(glm::dvec2{0, 0}) : std::nullopt;
  const double theta_rad = std::atan2(off_axis, p_optical.z);
  return glm::dvec2{p_optical.x / off_axis, p_optical.y / off_axis} * theta_rad;
}

glm::dvec3 KannalaBrandt::ray_of(const glm::dvec2& p) {
  const double theta_rad = glm::length(p);
  return {p * sine_over(theta_rad), std::cos(theta_rad)};
}

glm::dvec2 KannalaBrandt::stretch(const glm::dvec2& p) {
  return {1, 1 / sine_over(glm::length(p))};
}

}  // namespace sigs::distortion
