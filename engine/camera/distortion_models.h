// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/glm.hpp>
#include <limits>
#include <numeric>
#include <optional>
#include <span>
#include <vector>

namespace sigs::distortion {

// Numerical tools of the lens models: polynomials, the inverse of an increasing function, and measures of vectors and
// matrices.

// Polynomial in one variable, coefficients in ascending order: c[0] + c[1] u + c[2] u^2 + ...
using Polynomial = std::vector<double>;

// The polynomial's value at u, by Horner's scheme. An empty polynomial is zero.
[[nodiscard]] double value_at(const Polynomial& polynomial, double u);

// The derivative by u; empty for constants.
[[nodiscard]] Polynomial derivative(const Polynomial& polynomial);

// a * b
[[nodiscard]] Polynomial product(const Polynomial& a, const Polynomial& b);

// a + b_factor * b
[[nodiscard]] Polynomial sum(const Polynomial& a, const Polynomial& b, double b_factor = 1);

// Smallest u in (0, limit] from which on the polynomial, positive at 0, is no longer positive; infinity where there is
// none. The result is exact to the last bits, however narrow the dip: between two roots of its derivative a polynomial
// is monotonic, so that bisection finds every change of sign.
[[nodiscard]] double first_fall(const Polynomial& polynomial, double limit);

// A function's value and its derivative at one place.
struct ValueAndSlope {
  double value = 0;
  double slope = 0;
};

// The x in [0, highest] at which an increasing function takes a value; nothing where the function does not reach it.
//   f  double -> ValueAndSlope, with f(0) = 0 and slope 1 there
// Newton's method. A step that leaves the bracket in which the answer is known to lie is replaced by bisection, so the
// search always ends.
template <class Function>
[[nodiscard]] std::optional<double> increasing_inverse(const Function& f, double value, double highest) {
  if (!(value >= 0 && value <= f(highest).value)) return std::nullopt;
  double low = 0;
  double high = highest;
  double x = std::min(value, highest);
  constexpr int kMaxSteps = 400;  // bisection of a bracket of any doubles takes fewer
  for (int step = 0; step < kMaxSteps; ++step) {
    const auto [y, slope] = f(x);
    if (y == value) return x;
    (y < value ? low : high) = x;
    double next = x - (y - value) / slope;
    if (!(next > low && next < high)) next = std::midpoint(low, high);
    if (std::abs(next - x) <= std::numeric_limits<double>::epsilon() * x) return next;
    x = next;
  }
  return x;
}

// Largest singular value of a 2x2 matrix: the most by which it stretches a vector. Closed form, from the eigenvalues of
// the transposed matrix times the matrix.
[[nodiscard]] inline double largest_singular_value(const glm::dmat2& m) {
  const double first = glm::dot(m[0], m[0]);
  const double second = glm::dot(m[1], m[1]);
  return std::sqrt((first + second + std::hypot(first - second, 2 * glm::dot(m[0], m[1]))) / 2);
}

// Angle between two vectors of any length, 0..pi, accurate for the smallest angles too. 0 where one of them is zero.
[[nodiscard]] inline double angle_between(const glm::dvec3& a, const glm::dvec3& b) {
  return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

// The formulas of the lens models. Each maps points p of an undistorted plane to a distorted plane, from which
// focal length and principal point lead to pixels: pixel = focal * distorted(p) + center. The undistorted plane is the
// model's own; plane_of() and ray_of() convert between it and directions in OpenCV's optical frame (x right, y down, z
// forward). No model checks whether p lies in the field on which it is one to one: see valid_field().

// The distortion model of OpenCV's calib3d (Brown 1966, Conrady 1919, with the rational, thin prism and tilted sensor
// terms). Its plane is the image plane at distance 1: p = (x / z, y / z), so that |p| is the tangent of the angle from
// the axis.
//   u = |p|^2,  N = 1 + k1 u + k2 u^2 + k3 u^3,  D = 1 + k4 u + k5 u^2 + k6 u^3
//   x'' = x N / D + 2 p1 x y + p2 (u + 2 x^2) + s1 u + s2 u^2
//   y'' = y N / D + p1 (u + 2 y^2) + 2 p2 x y + s3 u + s4 u^2
//   w (x''', y''', 1) = tilt (x'', y'', 1)
struct BrownConrady {
  double k1 = 0, k2 = 0, k3 = 0, k4 = 0, k5 = 0, k6 = 0;  // radial
  double p1 = 0, p2 = 0;                                  // tangential
  double s1 = 0, s2 = 0, s3 = 0, s4 = 0;                  // thin prism
  glm::dmat3 tilt{1};                                     // of the sensor
  glm::dmat3 tilt_inverse{1};
  bool radial_only = true;  // neither p nor s: before the tilt, a circle around the axis stays a circle
  bool tilted = false;      // tilt is not the identity

  // The model of coefficients in OpenCV's order k1 k2 p1 p2 k3 k4 k5 k6 s1 s2 s3 s4 tau_x tau_y (the tilts in radians).
  // Missing ones are zero.
  [[nodiscard]] static BrownConrady of(std::span<const double> coefficients);

  // Everything but the tilt: (x'', y''), and its Jacobian (column i: the derivative by p[i]).
  [[nodiscard]] glm::dvec2 distorted_before_tilt(const glm::dvec2& p) const;
  [[nodiscard]] glm::dmat2 jacobian_before_tilt(const glm::dvec2& p) const;

  // The radial part alone, at |p| = r: r N / D and its derivative by r.
  [[nodiscard]] ValueAndSlope radial(double r) const;

  // The whole model: (x''', y'''), and its Jacobian.
  [[nodiscard]] glm::dvec2 distorted(const glm::dvec2& p) const;
  [[nodiscard]] glm::dmat2 jacobian(const glm::dvec2& p) const;

  // (x'', y'') of (x''', y'''). Nothing where the point lies beyond the tilted sensor's horizon.
  [[nodiscard]] std::optional<glm::dvec2> untilted(const glm::dvec2& distorted_point) const;

  // The plane's point of a direction (any length); nothing where the direction does not point forward.
  [[nodiscard]] static std::optional<glm::dvec2> plane_of(const glm::dvec3& p_optical);

  // The unit direction of a point of the plane.
  [[nodiscard]] static glm::dvec3 ray_of(const glm::dvec2& p);

  // How fast p moves when the direction turns, per radian: along the radius (x) and perpendicular to it (y).
  [[nodiscard]] static glm::dvec2 stretch(const glm::dvec2& p);
};

// The undistorted plane of fisheye models, the equidistant one: p points from the axis towards the direction, and its
// length is the angle theta from the axis in radians, so that directions beside and behind the camera have points too.
struct EquidistantPlane {
  // The plane's point of a direction (any length). Nothing for the zero vector and for the direction exactly backwards,
  // whose image is a whole circle.
  [[nodiscard]] static std::optional<glm::dvec2> plane_of(const glm::dvec3& p_optical);

  // The unit direction of a point of the plane.
  [[nodiscard]] static glm::dvec3 ray_of(const glm::dvec2& p);

  // How fast p moves when the direction turns, per radian: along the radius (x) and perpendicular to it (y).
  [[nodiscard]] static glm::dvec2 stretch(const glm::dvec2& p);
};

// The fisheye model of OpenCV (Kannala and Brandt 2006, equation 6 without the asymmetric terms).
//   distorted = p (1 + k1 theta^2 + k2 theta^4 + k3 theta^6 + k4 theta^8)
struct KannalaBrandt : EquidistantPlane {
  std::array<double, 4> k{};

  // The model of coefficients k1 k2 k3 k4. Missing ones are zero.
  [[nodiscard]] static KannalaBrandt of(std::span<const double> coefficients);

  // |distorted| at |p| = theta, and its derivative by theta.
  [[nodiscard]] ValueAndSlope radial(double theta_rad) const;

  // The whole model, and its Jacobian (column i: the derivative by p[i]).
  [[nodiscard]] glm::dvec2 distorted(const glm::dvec2& p) const;
  [[nodiscard]] glm::dmat2 jacobian(const glm::dvec2& p) const;
};

// The projection of 360 degree footage, the plate carree of maps: p is the azimuth to the right of the axis, -pi to pi,
// and the angle below the horizontal plane through it, -pi/2 to pi/2. There is no distortion.
struct Equirectangular {
  // The model has no coefficients.
  [[nodiscard]] static Equirectangular of(std::span<const double> /*coefficients*/) { return {}; }

  [[nodiscard]] static glm::dvec2 distorted(const glm::dvec2& p) { return p; }
  [[nodiscard]] static glm::dmat2 jacobian(const glm::dvec2& /*p*/) { return glm::dmat2{1}; }

  // The plane's point of a direction (any length), the azimuth of the poles being 0. Nothing for the zero vector.
  [[nodiscard]] static std::optional<glm::dvec2> plane_of(const glm::dvec3& p_optical);

  // The unit direction of a point of the plane. Beyond a pole it is the direction over the pole.
  [[nodiscard]] static glm::dvec3 ray_of(const glm::dvec2& p);

  // How fast p moves when the direction turns, per radian: horizontally (x) and vertically (y), not along the radius.
  [[nodiscard]] static glm::dvec2 stretch(const glm::dvec2& p);
};

// The disk of a model's undistorted plane on which the model is one to one.
struct Field {
  // |p| < radius: a tangent (Brown-Conrady) or an angle in radians (on the equidistant plane), as in the model's plane.
  double radius = std::numeric_limits<double>::infinity();
  // Image of the disk's rim before the tilt: a closed polygon, its corners in order. Empty for models that keep
  // circles.
  std::vector<glm::dvec2> edge;
};

// Brown-Conrady: up to the first radius at which, anywhere on the circle,
//   - the radial part stops increasing, or the determinant of the Jacobian stops being positive (a fold), or
//   - the rational denominator falls to 1e-6, or the ray runs parallel to a tilted sensor.
// Where the determinant is positive on a disk, each circle in it is distorted to c e^{i phi} + d e^{2 i phi} + offset
// with |c| > 2 |d|, a curve that does not cross itself; so the map is one to one on the whole disk, not only locally.
// Without distortion there is no limit; with any, |p| stays below 1e8 (6e-7 degrees short of 90).
[[nodiscard]] Field valid_field(const BrownConrady& model);

// Kannala-Brandt: up to the first angle at which the distorted radius stops increasing, at most pi.
[[nodiscard]] Field valid_field(const KannalaBrandt& model);

// Equirectangular: all of its plane.
[[nodiscard]] inline Field valid_field(const Equirectangular& /*model*/) {
  return {};
}

}  // namespace sigs::distortion
