// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/glm.hpp>
#include <limits>
#include <numbers>
#include <numeric>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "camera/lens_model.h"

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
// Every model has these members too:
//   kModel          which one it is
//   kIsPerspective  without distortion it is a pinhole
//   kPeriod         width of the plane after which it repeats; 0: it does not
//   fault(k)        what is wrong with finite coefficients; empty where they are valid
//   angle_rad(r)    angle from the axis of the directions at a distance r from the plane's origin, that is from the
//   image's
//                   middle where there is no distortion; also for an infinite r

// The distortion model of OpenCV's calib3d (Brown 1966, Conrady 1919, with the rational, thin prism and tilted sensor
// terms). Its plane is the image plane at distance 1: p = (x / z, y / z), so that |p| is the tangent of the angle from
// the axis.
//   u = |p|^2,  N = 1 + k1 u + k2 u^2 + k3 u^3,  D = 1 + k4 u + k5 u^2 + k6 u^3
//   x'' = x N / D + 2 p1 x y + p2 (u + 2 x^2) + s1 u + s2 u^2
//   y'' = y N / D + p1 (u + 2 y^2) + 2 p2 x y + s3 u + s4 u^2
//   w (x''', y''', 1) = tilt (x'', y'', 1)
struct BrownConrady {
  static constexpr LensModel kModel = LensModel::brown_conrady;
  static constexpr bool kIsPerspective = true;
  static constexpr double kPeriod = 0;

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

  [[nodiscard]] static std::string fault(std::span<const double> coefficients);

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

  [[nodiscard]] static double angle_rad(double r) { return std::atan(r); }
};

// The undistorted plane of fisheye models, the equidistant one: p points from the axis towards the direction, and its
// length is the angle theta from the axis in radians, so that directions beside and behind the camera have points too.
struct EquidistantPlane {
  static constexpr bool kIsPerspective = false;
  static constexpr double kPeriod = 0;

  // The plane's point of a direction (any length). Nothing for the zero vector and for the direction exactly backwards,
  // whose image is a whole circle.
  [[nodiscard]] static std::optional<glm::dvec2> plane_of(const glm::dvec3& p_optical);

  // The unit direction of a point of the plane.
  [[nodiscard]] static glm::dvec3 ray_of(const glm::dvec2& p);

  // How fast p moves when the direction turns, per radian: along the radius (x) and perpendicular to it (y).
  [[nodiscard]] static glm::dvec2 stretch(const glm::dvec2& p);

  [[nodiscard]] static double angle_rad(double r) { return r; }
};

// The fisheye model of OpenCV (Kannala and Brandt 2006, equation 6 without the asymmetric terms).
//   distorted = p (1 + k1 theta^2 + k2 theta^4 + k3 theta^6 + k4 theta^8)
struct KannalaBrandt : EquidistantPlane {
  static constexpr LensModel kModel = LensModel::kannala_brandt;

  std::array<double, 4> k{};

  // The model of coefficients k1 k2 k3 k4. Missing ones are zero.
  [[nodiscard]] static KannalaBrandt of(std::span<const double> coefficients);

  [[nodiscard]] static std::string fault(std::span<const double> /*coefficients*/) { return {}; }

  // |distorted| at |p| = theta, and its derivative by theta.
  [[nodiscard]] ValueAndSlope radial(double theta_rad) const;

  // The whole model, and its Jacobian (column i: the derivative by p[i]).
  [[nodiscard]] glm::dvec2 distorted(const glm::dvec2& p) const;
  [[nodiscard]] glm::dmat2 jacobian(const glm::dvec2& p) const;
};

// The omnidirectional model (Mei and Rives 2007; OpenCV's omnidir, Kalibr's omni): directions meet the unit sphere, are
// seen from a point xi behind its centre, and are then distorted as by Brown-Conrady with k1 k2 p1 p2:
//   p = (x, y) / (z + xi d),  d = |(x, y, z)|;   the distorted x grows by skew times the distorted y
struct Omnidirectional : BrownConrady {
  static constexpr LensModel kModel = LensModel::omnidirectional;
  static constexpr bool kIsPerspective = false;

  double xi = 0;    // at least 0; 0: a pinhole, 1: a parabolic mirror, about 1 for fisheyes
  double skew = 0;  // the camera matrix's, as a share of fx

  // The model of coefficients xi k1 k2 p1 p2 skew. Missing ones are zero.
  [[nodiscard]] static Omnidirectional of(std::span<const double> coefficients);
  [[nodiscard]] static std::string fault(std::span<const double> coefficients);

  [[nodiscard]] glm::dvec2 distorted(const glm::dvec2& p) const;
  [[nodiscard]] glm::dmat2 jacobian(const glm::dvec2& p) const;

  // As those of the other models. Nothing beyond the cone whose directions the sphere shows one to one.
  [[nodiscard]] std::optional<glm::dvec2> plane_of(const glm::dvec3& p_optical) const;
  [[nodiscard]] glm::dvec3 ray_of(const glm::dvec2& p) const;
  [[nodiscard]] glm::dvec2 stretch(const glm::dvec2& p) const;
  [[nodiscard]] double angle_rad(double r) const;
};

// The plane of models that have no distortion besides the projection itself.
struct UndistortedPlane {
  static constexpr bool kIsPerspective = false;
  static constexpr double kPeriod = 0;

  [[nodiscard]] static glm::dvec2 distorted(const glm::dvec2& p) { return p; }
  [[nodiscard]] static glm::dmat2 jacobian(const glm::dvec2& /*p*/) { return glm::dmat2{1}; }
};

// The double sphere model (Usenko, Demmel and Cremers 2018; Kalibr's ds), with d1 = |(x, y, z)|, k = xi d1 + z and
// d2 = |(x, y, k)|:
//   p = (x, y) / (alpha d2 + (1 - alpha) k)
struct DoubleSphere : UndistortedPlane {
  static constexpr LensModel kModel = LensModel::double_sphere;

  double xi = 0;     // above -1, below 1
  double alpha = 0;  // 0 to 1

  // The model of coefficients xi alpha.
  [[nodiscard]] static DoubleSphere of(std::span<const double> coefficients);
  [[nodiscard]] static std::string fault(std::span<const double> coefficients);

  // As those of the other models. Nothing beyond the cone in which the model is one to one.
  [[nodiscard]] std::optional<glm::dvec2> plane_of(const glm::dvec3& p_optical) const;
  [[nodiscard]] glm::dvec3 ray_of(const glm::dvec2& p) const;
  [[nodiscard]] glm::dvec2 stretch(const glm::dvec2& p) const;
  [[nodiscard]] double angle_rad(double r) const;
};

// The extended unified model (Khomutenko, Garcia and Martinet 2016; Kalibr's eucm):
//   p = (x, y) / (alpha sqrt(beta (x^2 + y^2) + z^2) + (1 - alpha) z)
struct ExtendedUnified : UndistortedPlane {
  static constexpr LensModel kModel = LensModel::extended_unified;

  double alpha = 0;  // 0 to 1
  double beta = 1;   // above 0

  // The model of coefficients alpha beta.
  [[nodiscard]] static ExtendedUnified of(std::span<const double> coefficients);
  [[nodiscard]] static std::string fault(std::span<const double> coefficients);

  // As those of the other models. Nothing beyond the cone in which the model is one to one.
  [[nodiscard]] std::optional<glm::dvec2> plane_of(const glm::dvec3& p_optical) const;
  [[nodiscard]] glm::dvec3 ray_of(const glm::dvec2& p) const;
  [[nodiscard]] glm::dvec2 stretch(const glm::dvec2& p) const;
  [[nodiscard]] double angle_rad(double r) const;
};

// The projection of 360 degree footage, the plate carree of maps: p is the azimuth to the right of the axis, -pi to pi,
// and the angle below the horizontal plane through it, -pi/2 to pi/2. There is no distortion.
struct Equirectangular : UndistortedPlane {
  static constexpr LensModel kModel = LensModel::equirectangular;
  static constexpr double kPeriod = 2 * std::numbers::pi;

  // The model has no coefficients.
  [[nodiscard]] static Equirectangular of(std::span<const double> /*coefficients*/) { return {}; }

  [[nodiscard]] static std::string fault(std::span<const double> /*coefficients*/) { return {}; }

  // The plane's point of a direction (any length), the azimuth of the poles being 0. Nothing for the zero vector.
  [[nodiscard]] static std::optional<glm::dvec2> plane_of(const glm::dvec3& p_optical);

  // The unit direction of a point of the plane. Beyond a pole it is the direction over the pole.
  [[nodiscard]] static glm::dvec3 ray_of(const glm::dvec2& p);

  // How fast p moves when the direction turns, per radian: horizontally (x) and vertically (y), not along the radius.
  [[nodiscard]] static glm::dvec2 stretch(const glm::dvec2& p);

  // All directions have an image: the angle of the farthest.
  [[nodiscard]] static double angle_rad(double /*r*/) { return std::numbers::pi; }
};

// Any of them, in the order of LensModel.
using Model =
    std::variant<BrownConrady, KannalaBrandt, Omnidirectional, DoubleSphere, ExtendedUnified, Equirectangular>;

// The model with these coefficients, as its of() makes it.
[[nodiscard]] Model model_of(LensModel model, std::span<const double> coefficients);

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

// Omnidirectional: as Brown-Conrady on its plane, up to where the sphere is seen at its rim.
[[nodiscard]] Field valid_field(const Omnidirectional& model);

// Double sphere, extended unified: up to the angle at which the distance from the axis stops increasing or is infinite.
[[nodiscard]] Field valid_field(const DoubleSphere& model);
[[nodiscard]] Field valid_field(const ExtendedUnified& model);

// Equirectangular: all of its plane.
[[nodiscard]] inline Field valid_field(const Equirectangular& /*model*/) {
  return {};
}

// The inverse: the p within the field that a model distorts to a given point, to the last digits that the arithmetic
// holds; nothing where there is none. For radial models one number is solved for. Where tangential or prism terms
// couple x and y, damped Newton's method in the plane starts from the radial answer; where it fails and the point is
// not clearly outside the distorted rim of the field, the whole field is searched.
[[nodiscard]] std::optional<glm::dvec2> undistorted(const BrownConrady& model, const Field& field,
                                                    const glm::dvec2& distorted_point);
[[nodiscard]] std::optional<glm::dvec2> undistorted(const KannalaBrandt& model, const Field& field,
                                                    const glm::dvec2& distorted_point);

[[nodiscard]] std::optional<glm::dvec2> undistorted(const Omnidirectional& model, const Field& field,
                                                    const glm::dvec2& distorted_point);

// Double sphere, extended unified: the point itself, within the field.
[[nodiscard]] std::optional<glm::dvec2> undistorted(const UndistortedPlane& model, const Field& field,
                                                    const glm::dvec2& distorted_point);

// Equirectangular: over a pole as far as to the other one.
[[nodiscard]] std::optional<glm::dvec2> undistorted(const Equirectangular& model, const Field& field,
                                                    const glm::dvec2& distorted_point);

// How far the pixel of p moves, at most, when the direction turns by a small angle; px per radian.
//   focal_px  of columns and of rows
template <class Model>
[[nodiscard]] double magnification(const Model& model, const glm::dvec2& p, const glm::dvec2& focal_px) {
  const double r = glm::length(p);
  const glm::dvec2 along = r > 0 ? p / r : glm::dvec2{1, 0};
  const glm::dvec2 across{-along.y, along.x};
  const glm::dvec2 stretch = model.stretch(p);
  const glm::dmat2 jacobian = model.jacobian(p);
  return largest_singular_value(
      {focal_px * (jacobian * along) * stretch.x, focal_px * (jacobian * across) * stretch.y});
}

// Equirectangular: within half a pixel of a pole what it is there.
[[nodiscard]] inline double magnification(const Equirectangular& model, const glm::dvec2& p,
                                          const glm::dvec2& focal_px) {
  return std::max(std::min(focal_px.x * model.stretch(p).x, focal_px.x * 2 * focal_px.y), focal_px.y);
}

}  // namespace sigs::distortion
