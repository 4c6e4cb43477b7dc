// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <string>

#include "camera/distortion_models.h"

namespace sigs::distortion {
namespace {

// Of the models that look at a sphere or its like, a direction (x, y, z) is seen at (x, y) / depth.

struct Depth {
  double value = 0;
  double slope = 0;  // by the angle from the axis, for unit directions
};

struct CosineAndSine {
  double cosine = 0;
  double sine = 0;
};

CosineAndSine cosine_and_sine(const glm::dvec3& unit_ray) {
  return {unit_ray.z, std::hypot(unit_ray.x, unit_ray.y)};
}

double angle_from_axis_rad(const glm::dvec3& ray) {
  return std::atan2(std::hypot(ray.x, ray.y), ray.z);
}

// Of r = sine / depth: along the radius dr/dtheta, perpendicular to it r / sine.
glm::dvec2 stretch_of(double cosine, double sine, const Depth& depth) {
  return {(cosine * depth.value - sine * depth.slope) / (depth.value * depth.value), 1 / depth.value};
}

// The point of a direction within a cone round the axis; nothing beyond it.
//   depth  of the direction and its length
template <class DepthOf>
std::optional<glm::dvec2> seen_in_cone(const glm::dvec3& p, double cosine_of_cone, const DepthOf& depth) {
  const double d = std::hypot(p.x, p.y, p.z);
  if (!(p.z > cosine_of_cone * d)) return std::nullopt;
  return glm::dvec2{p} / depth(p, d);
}

// Omnidirectional: beyond the cone the sphere is seen from within its other half, or not at all.
double cosine_of_cone(double xi) {
  return xi <= 1 ? -xi : -1 / xi;
}

// w1 of the papers on the double sphere and the extended unified model.
double share_of(double alpha) {
  return alpha <= 0.5 ? alpha / (1 - alpha) : (1 - alpha) / alpha;
}

// The model depends on the angle alone under which the second sphere's middle sees the point of the first one: it is
// one to one as long as that angle's cosine, (cosine + xi) / |(sine, cosine + xi)|, is above -w. (The paper's z > -w2
// d1 is narrower, by up to some degrees.)
double cosine_of_cone(const DoubleSphere& m) {
  const double w = share_of(m.alpha);
  const double rest = 1 - w * w;
  return -m.xi * rest - w * std::sqrt(1 - m.xi * m.xi * rest);
}

}  // namespace

Omnidirectional Omnidirectional::of(std::span<const double> coefficients) {
  std::array<double, 6> c{};
  for (std::size_t i = 0; i < coefficients.size() && i < c.size(); ++i) c[i] = coefficients[i];
  Omnidirectional model;
  static_cast<BrownConrady&>(model) = BrownConrady::of(std::span(c).subspan(1, 4));
  model.xi = c[0];
  model.skew = c[5];
  return model;
}

std::string Omnidirectional::fault(std::span<const double> coefficients) {
  return coefficients[0] >= 0 ? "" : "xi, the first coefficient, must be at least 0";
}

glm::dvec2 Omnidirectional::distorted(const glm::dvec2& p) const {
  const glm::dvec2 straight = BrownConrady::distorted(p);
  return {straight.x + skew * straight.y, straight.y};
}

glm::dmat2 Omnidirectional::jacobian(const glm::dvec2& p) const {
  glm::dmat2 straight = BrownConrady::jacobian(p);
  for (int axis = 0; axis < 2; ++axis) straight[axis].x += skew * straight[axis].y;
  return straight;
}

std::optional<glm::dvec2> Omnidirectional::plane_of(const glm::dvec3& p_optical) const {
  return seen_in_cone(p_optical, cosine_of_cone(xi), [&](const glm::dvec3& p, double d) { return p.z + xi * d; });
}

glm::dvec3 Omnidirectional::ray_of(const glm::dvec2& p) const {
  const double square = glm::dot(p, p);
  const double eta = (xi + std::sqrt(std::max(0.0, 1 + (1 - xi * xi) * square))) / (1 + square);
  return glm::normalize(glm::dvec3{eta * p, eta - xi});
}

glm::dvec2 Omnidirectional::stretch(const glm::dvec2& p) const {
  const auto [cosine, sine] = cosine_and_sine(ray_of(p));
  return stretch_of(cosine, sine, {cosine + xi, -sine});
}

double Omnidirectional::angle_rad(double r) const {
  return std::isfinite(r) ? angle_from_axis_rad(ray_of({r, 0})) : std::acos(cosine_of_cone(xi));
}

DoubleSphere DoubleSphere::of(std::span<const double> coefficients) {
  DoubleSphere model;
  if (coefficients.size() == 2) model.xi = coefficients[0], model.alpha = coefficients[1];
  return model;
}

std::string DoubleSphere::fault(std::span<const double> coefficients) {
  if (!(std::abs(coefficients[0]) < 1)) return "xi, the first coefficient, must lie between -1 and 1";
  if (!(coefficients[1] >= 0 && coefficients[1] <= 1)) return "alpha, the second coefficient, must be 0 to 1";
  return {};
}

std::optional<glm::dvec2> DoubleSphere::plane_of(const glm::dvec3& p_optical) const {
  return seen_in_cone(p_optical, cosine_of_cone(*this), [&](const glm::dvec3& p, double d) {
    const double k = xi * d + p.z;
    return alpha * std::hypot(p.x, p.y, k) + (1 - alpha) * k;
  });
}

glm::dvec3 DoubleSphere::ray_of(const glm::dvec2& p) const {
  const double square = glm::dot(p, p);
  const double k =
      (1 - alpha * alpha * square) / (alpha * std::sqrt(std::max(0.0, 1 - (2 * alpha - 1) * square)) + 1 - alpha);
  const double scale = (k * xi + std::sqrt(std::max(0.0, k * k + (1 - xi * xi) * square))) / (k * k + square);
  return glm::normalize(glm::dvec3{scale * p, scale * k - xi});
}

glm::dvec2 DoubleSphere::stretch(const glm::dvec2& p) const {
  const auto [cosine, sine] = cosine_and_sine(ray_of(p));
  const double k = xi + cosine;
  const double d2 = std::hypot(sine, k);
  return stretch_of(cosine, sine, {alpha * d2 + (1 - alpha) * k, -alpha * sine * xi / d2 - (1 - alpha) * sine});
}

double DoubleSphere::angle_rad(double r) const {
  return std::isfinite(r) ? angle_from_axis_rad(ray_of({r, 0})) : std::acos(cosine_of_cone(*this));
}

ExtendedUnified ExtendedUnified::of(std::span<const double> coefficients) {
  ExtendedUnified model;
  if (coefficients.size() == 2) model.alpha = coefficients[0], model.beta = coefficients[1];
  return model;
}

std::string ExtendedUnified::fault(std::span<const double> coefficients) {
  if (!(coefficients[0] >= 0 && coefficients[0] <= 1)) return "alpha, the first coefficient, must be 0 to 1";
  if (!(coefficients[1] > 0)) return "beta, the second coefficient, must be positive";
  return {};
}

std::optional<glm::dvec2> ExtendedUnified::plane_of(const glm::dvec3& p_optical) const {
  const double d = std::hypot(std::sqrt(beta) * p_optical.x, std::sqrt(beta) * p_optical.y, p_optical.z);
  if (!(p_optical.z > -share_of(alpha) * d)) return std::nullopt;
  return glm::dvec2{p_optical} / (alpha * d + (1 - alpha) * p_optical.z);
}

glm::dvec3 ExtendedUnified::ray_of(const glm::dvec2& p) const {
  const double square = beta * glm::dot(p, p);
  const double z =
      (1 - alpha * alpha * square) / (alpha * std::sqrt(std::max(0.0, 1 - (2 * alpha - 1) * square)) + 1 - alpha);
  return glm::normalize(glm::dvec3{p, z});
}

glm::dvec2 ExtendedUnified::stretch(const glm::dvec2& p) const {
  const auto [cosine, sine] = cosine_and_sine(ray_of(p));
  const double d = std::hypot(std::sqrt(beta) * sine, cosine);
  return stretch_of(cosine, sine,
                    {alpha * d + (1 - alpha) * cosine, alpha * (beta - 1) * sine * cosine / d - (1 - alpha) * sine});
}

// z = -w sqrt(beta sine^2 + z^2) at the rim.
double ExtendedUnified::angle_rad(double r) const {
  if (std::isfinite(r)) return angle_from_axis_rad(ray_of({r, 0}));
  const double w = share_of(alpha);
  return std::atan2(std::sqrt(1 - w * w), -w * std::sqrt(beta));
}

}  // namespace sigs::distortion
