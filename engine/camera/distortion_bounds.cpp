// SPDX-License-Identifier: MIT
#include "camera/distortion_bounds.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

namespace sigs::distortion {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr DistortionBounds kUnknown{kInfinity, kInfinity};

// A function's value and derivatives, the n-th in place n; or bounds of their magnitudes.
using Derivatives = std::array<double, 5>;

// Of a polynomial, lowest coefficient first.
Derivatives derivatives_of(const std::array<double, 5>& coefficients, double u) {
  Derivatives result{};
  std::array<double, 5> c = coefficients;
  for (double& value : result) {
    for (std::size_t i = c.size(); i-- > 0;) value = value * u + c[i];
    for (std::size_t i = 0; i + 1 < c.size(); ++i) c[i] = static_cast<double>(i + 1) * c[i + 1];
    c.back() = 0;
  }
  return result;
}

// Within `reach` of where a polynomial has these: Taylor's series, which ends.
Derivatives largest_of(const Derivatives& at, double reach) {
  Derivatives result{};
  for (std::size_t n = 0; n < at.size(); ++n) {
    double power = 1;
    for (std::size_t j = 0; n + j < at.size(); ++j) {
      result[n] += std::abs(at[n + j]) * power;
      power *= reach / static_cast<double>(j + 1);
    }
  }
  return result;
}

// Of a quotient q up to the third: (q d)^(n) = n^(n), solved for q^(n). `sign` is -1 for the quotient itself, and 1 for
// a bound from bounds, where nothing may cancel.
Derivatives quotient(const Derivatives& n, const Derivatives& d, double divisor, double sign) {
  Derivatives q{};
  q[0] = n[0] / divisor;
  q[1] = (n[1] + sign * q[0] * d[1]) / divisor;
  q[2] = (n[2] + sign * (2 * q[1] * d[1] + q[0] * d[2])) / divisor;
  q[3] = (n[3] + sign * (3 * q[2] * d[1] + 3 * q[1] * d[2] + q[0] * d[3])) / divisor;
  return q;
}

// Bounds of a quotient of polynomials and of its derivatives up to the second, within reach of u. From the middle
// outwards, because a numerator and a denominator that grow alike cancel there.
Derivatives largest_quotient(const std::array<double, 5>& numerator, const std::array<double, 5>& denominator, double u,
                             double reach) {
  const Derivatives n = derivatives_of(numerator, u);
  const Derivatives d = derivatives_of(denominator, u);
  const Derivatives largest_d = largest_of(d, reach);
  const double smallest_d = 2 * std::abs(d[0]) - largest_d[0];
  if (!(smallest_d > 0)) return {kInfinity, kInfinity, kInfinity, kInfinity, kInfinity};
  const Derivatives middle = quotient(n, d, d[0], -1);
  Derivatives largest = quotient(largest_of(n, reach), largest_d, smallest_d, 1);
  for (std::size_t i = 3; i-- > 0;) largest[i] = std::min(largest[i], std::abs(middle[i]) + reach * largest[i + 1]);
  return largest;
}

// p q(p . p): the derivatives along a line of unit direction h are
//   h q + 2 p (p . h) q'   and   (4 h (p . h) + 2 p) q' + 4 p (p . h)^2 q''
DistortionBounds radial_distortion_bounds(const Derivatives& q, double r) {
  return {q[0] + 2 * r * r * q[1], 6 * r * q[1] + 4 * r * r * r * q[2]};
}

// Behind a tilted sensor, v goes to (A v)_xy / (A v)_z.
DistortionBounds tilted(const BrownConrady& m, const DistortionBounds& flat, const glm::dvec2& center, double radius) {
  const glm::dvec3 projected = m.tilt * glm::dvec3{m.distorted_before_tilt(center), 1};
  const auto norm = [](double a, double b, double c, double d) { return std::sqrt(a * a + b * b + c * c + d * d); };
  const double across = norm(m.tilt[0].x, m.tilt[0].y, m.tilt[1].x, m.tilt[1].y);
  const double along = norm(m.tilt[0].z, m.tilt[1].z, 0, 0);
  const double moved = flat.slope * radius;
  const double depth = projected.z - along * moved;
  if (!(depth > 0)) return kUnknown;
  const double farthest = (glm::length(glm::dvec2(projected)) + across * moved) / depth;
  const double slope = (across + farthest * along) / depth;
  constexpr double kBothCoordinates = 1.5;  // > sqrt(2): the curvature is one coordinate's
  return {slope * flat.slope,
          slope * (kBothCoordinates * flat.curvature + 2 * along / depth * flat.slope * flat.slope)};
}

DistortionBounds known_or_none(const DistortionBounds& bend) {
  return std::isfinite(bend.slope) && std::isfinite(bend.curvature) ? bend : kUnknown;
}

}  // namespace

DistortionBounds max_distortion(const BrownConrady& m, const glm::dvec2& center, double radius) {
  const double middle = glm::length(center);
  const double r = middle + radius;
  const Derivatives q =
      largest_quotient({1, m.k1, m.k2, m.k3, 0}, {1, m.k4, m.k5, m.k6, 0}, middle * middle, r * r - middle * middle);
  DistortionBounds bend = radial_distortion_bounds(q, r);
  const double tangential = std::abs(m.p1) + std::abs(m.p2);
  const double prism = std::abs(m.s1) + std::abs(m.s3);
  const double steep_prism = std::abs(m.s2) + std::abs(m.s4);
  bend.slope += 12 * tangential * r + 2 * prism * r + 4 * steep_prism * r * r * r;
  bend.curvature += 6 * tangential + 2 * prism + 12 * steep_prism * r * r;
  return known_or_none(m.tilted ? tilted(m, bend, center, radius) : bend);
}

DistortionBounds max_distortion(const KannalaBrandt& m, const glm::dvec2& center, double radius) {
  const double middle = glm::length(center);
  const double r = middle + radius;
  const Derivatives q =
      largest_of(derivatives_of({1, m.k[0], m.k[1], m.k[2], m.k[3]}, middle * middle), r * r - middle * middle);
  return known_or_none(radial_distortion_bounds(q, r));
}

}  // namespace sigs::distortion
