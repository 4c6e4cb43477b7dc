// SPDX-License-Identifier: MIT
#include "camera/distortion_models.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <numeric>
#include <string>
#include <utility>

namespace sigs::distortion {
namespace {

// Where the sign of the polynomial changes between a and b, by bisection; the last number on the side of a.
double sign_change_between(const Polynomial& polynomial, double a, double b) {
  const bool positive_at_a = value_at(polynomial, a) > 0;
  for (;;) {
    const double middle = std::midpoint(a, b);
    if (middle == a || middle == b) return a;
    ((value_at(polynomial, middle) > 0) == positive_at_a ? a : b) = middle;
  }
}

// Ends of the intervals of (0, limit] on which the polynomial is monotonic, and limit itself.
std::vector<double> turning_points(const Polynomial& polynomial, double limit);

// All numbers in (0, limit] where the sign changes, ascending.
std::vector<double> sign_changes(const Polynomial& polynomial, double limit) {
  std::vector<double> changes;
  double from = 0;
  for (const double to : turning_points(polynomial, limit)) {
    if ((value_at(polynomial, from) > 0) != (value_at(polynomial, to) > 0))
      changes.push_back(sign_change_between(polynomial, from, to));
    from = to;
  }
  return changes;
}

std::vector<double> turning_points(const Polynomial& polynomial, double limit) {
  std::vector<double> points;
  if (polynomial.size() > 2) points = sign_changes(derivative(polynomial), limit);
  points.push_back(limit);
  return points;
}

struct Ratio {
  double value = 1;  // N / D
  double slope = 0;  // its derivative by u
};

Ratio ratio(const BrownConrady& m, double u) {
  const double numerator = 1 + u * (m.k1 + u * (m.k2 + u * m.k3));
  const double denominator = 1 + u * (m.k4 + u * (m.k5 + u * m.k6));
  const double numerator_slope = m.k1 + u * (2 * m.k2 + u * 3 * m.k3);
  const double denominator_slope = m.k4 + u * (2 * m.k5 + u * 3 * m.k6);
  const double value = numerator / denominator;
  return {value, (numerator_slope - value * denominator_slope) / denominator};
}

// Scheimpflug tilt (OpenCV's computeTiltProjectionMatrix): the sensor plane is rotated by R = Ry(tau_y) Rx(tau_x),
// which takes (x'', y'', 1) to a point (X, Y, Z) in the sensor's frame. The projection along the optical axis has to
// keep the axis at (0, 0): with c = R (0, 0, 1), the third column, it is c_z X / Z - c_x and c_z Y / Z - c_y. These are
// the rows of along_axis.
glm::dmat3 tilt_matrix(double tau_x, double tau_y) {
  const double cx = std::cos(tau_x);
  const double sx = std::sin(tau_x);
  const double cy = std::cos(tau_y);
  const double sy = std::sin(tau_y);
  const glm::dmat3 about_x{{1, 0, 0}, {0, cx, -sx}, {0, sx, cx}};  // columns
  const glm::dmat3 about_y{{cy, 0, sy}, {0, 1, 0}, {-sy, 0, cy}};
  const glm::dmat3 turn = about_y * about_x;
  const glm::dvec3 axis = turn[2];
  const glm::dmat3 along_axis{{axis.z, 0, 0}, {0, axis.z, 0}, {-axis.x, -axis.y, 1}};
  return along_axis * turn;
}

template <std::size_t... index>
Model model_at(std::size_t wanted, std::span<const double> coefficients, std::index_sequence<index...> /*all*/) {
  static_assert(((static_cast<std::size_t>(std::variant_alternative_t<index, Model>::kModel) == index) && ...),
                "the models are in the order of LensModel");
  Model model;
  ((index == wanted ? void(model = std::variant_alternative_t<index, Model>::of(coefficients)) : void()), ...);
  return model;
}

// sin(t) / t, 1 at zero. Below the limit the next term of the series, t^4 / 120, is under the last bit.
double sine_over(double t) {
  constexpr double kSeriesBelow = 1e-4;
  return t < kSeriesBelow ? 1 - t * t / 6 : std::sin(t) / t;
}

}  // namespace

double value_at(const Polynomial& polynomial, double u) {
  return std::accumulate(polynomial.rbegin(), polynomial.rend(), 0.0,
                         [u](double sum_so_far, double c) { return sum_so_far * u + c; });
}

Polynomial derivative(const Polynomial& polynomial) {
  Polynomial result;
  for (std::size_t power = 1; power < polynomial.size(); ++power)
    result.push_back(polynomial[power] * static_cast<double>(power));
  return result;
}

Polynomial product(const Polynomial& a, const Polynomial& b) {
  if (a.empty() || b.empty()) return {};
  Polynomial result(a.size() + b.size() - 1, 0.0);
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t j = 0; j < b.size(); ++j) result[i + j] += a[i] * b[j];
  return result;
}

Polynomial sum(const Polynomial& a, const Polynomial& b, double b_factor) {
  Polynomial result(std::max(a.size(), b.size()), 0.0);
  for (std::size_t i = 0; i < a.size(); ++i) result[i] += a[i];
  for (std::size_t i = 0; i < b.size(); ++i) result[i] += b_factor * b[i];
  return result;
}

double first_fall(const Polynomial& polynomial, double limit) {
  const std::vector<double> changes = sign_changes(polynomial, limit);
  return changes.empty() ? std::numeric_limits<double>::infinity() : changes.front();
}

Model model_of(LensModel model, std::span<const double> coefficients) {
  return model_at(static_cast<std::size_t>(model), coefficients,
                  std::make_index_sequence<std::variant_size_v<Model>>());
}

std::string BrownConrady::fault(std::span<const double> coefficients) {
  const auto too_tilted = [](double tau_rad) { return std::abs(tau_rad) >= std::numbers::pi / 2; };
  if (coefficients.size() == 14 && (too_tilted(coefficients[12]) || too_tilted(coefficients[13])))
    return "the sensor's tilt (coefficients 13 and 14, radians) must be less than pi / 2";
  return {};
}

BrownConrady BrownConrady::of(std::span<const double> coefficients) {
  std::array<double, 14> c{};
  for (std::size_t i = 0; i < coefficients.size() && i < c.size(); ++i) c[i] = coefficients[i];
  BrownConrady m{.k1 = c[0],
                 .k2 = c[1],
                 .k3 = c[4],
                 .k4 = c[5],
                 .k5 = c[6],
                 .k6 = c[7],
                 .p1 = c[2],
                 .p2 = c[3],
                 .s1 = c[8],
                 .s2 = c[9],
                 .s3 = c[10],
                 .s4 = c[11]};
  m.radial_only = m.p1 == 0 && m.p2 == 0 && m.s1 == 0 && m.s2 == 0 && m.s3 == 0 && m.s4 == 0;
  m.tilted = c[12] != 0 || c[13] != 0;
  if (m.tilted) {
    m.tilt = tilt_matrix(c[12], c[13]);
    m.tilt_inverse = glm::inverse(m.tilt);
  }
  return m;
}

glm::dvec2 BrownConrady::distorted_before_tilt(const glm::dvec2& p) const {
  const double u = glm::dot(p, p);
  const double across = 2 * p.x * p.y;
  const glm::dvec2 tangential{p1 * across + p2 * (u + 2 * p.x * p.x), p1 * (u + 2 * p.y * p.y) + p2 * across};
  const glm::dvec2 prism{u * (s1 + u * s2), u * (s3 + u * s4)};
  return p * ratio(*this, u).value + tangential + prism;
}

glm::dmat2 BrownConrady::jacobian_before_tilt(const glm::dvec2& p) const {
  const double u = glm::dot(p, p);
  const Ratio r = ratio(*this, u);
  const double mixed = 2 * p.x * p.y * r.slope + 2 * p1 * p.x + 2 * p2 * p.y;
  const glm::dvec2 prism_slope{2 * (s1 + 2 * s2 * u), 2 * (s3 + 2 * s4 * u)};
  const double xx = r.value + 2 * p.x * p.x * r.slope + 2 * p1 * p.y + 6 * p2 * p.x;
  const double yy = r.value + 2 * p.y * p.y * r.slope + 6 * p1 * p.y + 2 * p2 * p.x;
  return {glm::dvec2{xx, mixed} + prism_slope * p.x, glm::dvec2{mixed, yy} + prism_slope * p.y};
}

ValueAndSlope BrownConrady::radial(double r) const {
  const double u = r * r;
  const Ratio n = ratio(*this, u);
  return {r * n.value, n.value + 2 * u * n.slope};
}

glm::dvec2 BrownConrady::distorted(const glm::dvec2& p) const {
  const glm::dvec2 flat = distorted_before_tilt(p);
  if (!tilted) return flat;
  const glm::dvec3 projected = tilt * glm::dvec3{flat, 1};
  return glm::dvec2{projected} / projected.z;
}

glm::dmat2 BrownConrady::jacobian(const glm::dvec2& p) const {
  const glm::dmat2 inner = jacobian_before_tilt(p);
  if (!tilted) return inner;
  const glm::dvec3 projected = tilt * glm::dvec3{distorted_before_tilt(p), 1};
  const glm::dvec2 at = glm::dvec2{projected} / projected.z;
  const glm::dmat2 outer{(glm::dvec2{tilt[0]} - at * tilt[0].z) / projected.z,
                         (glm::dvec2{tilt[1]} - at * tilt[1].z) / projected.z};
  return outer * inner;
}

std::optional<glm::dvec2> BrownConrady::untilted(const glm::dvec2& distorted_point) const {
  if (!tilted) return distorted_point;
  const glm::dvec3 flat = tilt_inverse * glm::dvec3{distorted_point, 1};
  if (!(flat.z > 0)) return std::nullopt;
  return glm::dvec2{flat} / flat.z;
}

std::optional<glm::dvec2> BrownConrady::plane_of(const glm::dvec3& p_optical) {
  if (!(p_optical.z > 0)) return std::nullopt;
  return glm::dvec2{p_optical.x / p_optical.z, p_optical.y / p_optical.z};
}

glm::dvec3 BrownConrady::ray_of(const glm::dvec2& p) {
  return glm::normalize(glm::dvec3{p, 1});
}

glm::dvec2 BrownConrady::stretch(const glm::dvec2& p) {
  // r = tan(theta): dr/dtheta = 1 + r^2. Perpendicular to the radius, a rotation by dphi about the axis moves p by r
  // dphi and is an angle of sin(theta) dphi.
  const double secant_squared = 1 + glm::dot(p, p);
  return {secant_squared, std::sqrt(secant_squared)};
}

std::optional<glm::dvec2> EquidistantPlane::plane_of(const glm::dvec3& p_optical) {
  const double off_axis = std::hypot(p_optical.x, p_optical.y);
  if (off_axis == 0) return p_optical.z > 0 ? std::optional(glm::dvec2{0, 0}) : std::nullopt;
  const double theta_rad = std::atan2(off_axis, p_optical.z);
  return glm::dvec2{p_optical.x / off_axis, p_optical.y / off_axis} * theta_rad;
}

glm::dvec3 EquidistantPlane::ray_of(const glm::dvec2& p) {
  const double theta_rad = glm::length(p);
  return {p * sine_over(theta_rad), std::cos(theta_rad)};
}

glm::dvec2 EquidistantPlane::stretch(const glm::dvec2& p) {
  return {1, 1 / sine_over(glm::length(p))};
}

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

std::optional<glm::dvec2> Equirectangular::plane_of(const glm::dvec3& p_optical) {
  if (p_optical == glm::dvec3(0)) return std::nullopt;
  return glm::dvec2{std::atan2(p_optical.x, p_optical.z),
                    std::atan2(p_optical.y, std::hypot(p_optical.x, p_optical.z))};
}

glm::dvec3 Equirectangular::ray_of(const glm::dvec2& p) {
  return {std::cos(p.y) * std::sin(p.x), std::sin(p.y), std::cos(p.y) * std::cos(p.x)};
}

glm::dvec2 Equirectangular::stretch(const glm::dvec2& p) {
  return {1 / std::max(std::cos(p.y), std::numeric_limits<double>::min()), 1};
}

}  // namespace sigs::distortion
