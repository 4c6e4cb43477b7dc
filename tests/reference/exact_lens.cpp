// SPDX-License-Identifier: MIT
#include "reference/exact_lens.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace sigs::truth {
namespace {

constexpr int kRadii = 3000;       // at which folds are looked for
constexpr int kDirections = 96;    // round each circle
constexpr double kWidest = 1.569;  // rad; a pinhole's known points go no farther than 0.1 degrees short of its plane

template <class Real>
using Matrix = std::array<std::array<Real, 3>, 3>;

template <class Real>
Matrix<Real> product(const Matrix<Real>& a, const Matrix<Real>& b) {
  Matrix<Real> out{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      for (std::size_t k = 0; k < 3; ++k) out[i][j] += a[i][k] * b[k][j];
  return out;
}

// Row by row as in OpenCV's documentation of the tilted sensor.
template <class Real>
Matrix<Real> tilt_of(Real tau_x, Real tau_y) {
  const Real cx = std::cos(tau_x);
  const Real sx = std::sin(tau_x);
  const Real cy = std::cos(tau_y);
  const Real sy = std::sin(tau_y);
  const Matrix<Real> about_y{{{cy, 0, -sy}, {0, 1, 0}, {sy, 0, cy}}};
  const Matrix<Real> about_x{{{1, 0, 0}, {0, cx, sx}, {0, -sx, cx}}};
  const Matrix<Real> r = product(about_y, about_x);
  const Matrix<Real> along{{{r[2][2], 0, -r[0][2]}, {0, r[2][2], -r[1][2]}, {0, 0, 1}}};
  return product(along, r);
}

}  // namespace

template <class Real>
ExactLens<Real>::ExactLens(const LensParameters& p)
    : model_(p.model),
      is_by_angle_(p.model != LensModel::brown_conrady && p.model != LensModel::equirectangular),
      is_sphere_(p.model == LensModel::equirectangular),
      focal_px_(p.fx, p.fy),
      center_px_(p.cx, p.cy) {
  for (std::size_t i = 0; i < p.coefficients.size() && i < k_.size(); ++i) k_[i] = Real(p.coefficients[i]);
  tilt_ = tilt_of(k_[12], k_[13]);
  field_radius_ = first_fold();
  known_ = known_points();
}

template <class Real>
Real ExactLens<Real>::field_angle_rad() const {
  if (is_sphere_) return std::numbers::pi_v<Real>;
  return is_by_angle_ ? field_radius_ : std::atan(field_radius_);
}

template <class Real>
auto ExactLens<Real>::brown_conrady(const Vec2& point) const -> Image {
  const auto& [k1, k2, p1, p2, k3, k4, k5, k6, s1, s2, s3, s4, tau_x, tau_y] = k_;
  const Number x{point.x, 1, 0};
  const Number y{point.y, 0, 1};
  const Number r2 = x * x + y * y;
  const Number r4 = r2 * r2;
  const Number below = Real(1) + r2 * (k4 + r2 * (k5 + k6 * r2));
  const Number radial = (Real(1) + r2 * (k1 + r2 * (k2 + k3 * r2))) / below;
  const Number xy = Real(2) * (x * y);
  const Number distorted_x = x * radial + p1 * xy + p2 * (r2 + Real(2) * (x * x)) + s1 * r2 + s2 * r4;
  const Number distorted_y = y * radial + p1 * (r2 + Real(2) * (y * y)) + p2 * xy + s3 * r2 + s4 * r4;
  if (tau_x == 0 && tau_y == 0) return {distorted_x, distorted_y, below.value > 0};
  const auto row = [&](std::size_t i) { return tilt_[i][2] + tilt_[i][0] * distorted_x + tilt_[i][1] * distorted_y; };
  const Number depth = row(2);
  return {row(0) / depth, row(1) / depth, below.value > 0 && depth.value * tilt_[2][2] > 0};
}

template <class Real>
auto ExactLens<Real>::kannala_brandt(const Vec2& point) const -> Image {
  const Number x{point.x, 1, 0};
  const Number y{point.y, 0, 1};
  const Number theta2 = x * x + y * y;
  const Number stretch = Real(1) + theta2 * (k_[0] + theta2 * (k_[1] + theta2 * (k_[2] + k_[3] * theta2)));
  return {x * stretch, y * stretch, true};
}

// With u the square of the angle t: x sin(t) / t, y sin(t) / t, cos(t), whose slopes by u are regular on the axis.
template <class Real>
auto ExactLens<Real>::ray_by_angle(const Vec2& point) -> Ray {
  const Number x{point.x, 1, 0};
  const Number y{point.y, 0, 1};
  const Number u = x * x + y * y;
  const Real t = std::sqrt(u.value);
  const bool is_near = t < Real(1e-3);
  const Real sinc = is_near ? 1 - u.value / 6 + u.value * u.value / 120 : std::sin(t) / t;
  const Real sinc_slope = is_near ? Real(-1) / 6 + u.value / 60 : (t * std::cos(t) - std::sin(t)) / (2 * t * t * t);
  const Number across{sinc, sinc_slope * u.by_x, sinc_slope * u.by_y};
  const Number z{std::cos(t), -sinc / 2 * u.by_x, -sinc / 2 * u.by_y};
  return {x * across, y * across, z};
}

// Mei and Rives: the sphere's points, seen from xi behind its middle, then k1 k2 p1 p2, then the skew.
template <class Real>
auto ExactLens<Real>::omnidirectional(const Ray& ray) const -> Image {
  const auto& [xi, k1, k2, p1, p2, skew, a, b, c, d, e, f, g, h] = k_;
  const Number depth = xi + ray.z;
  const Number x = ray.x / depth;
  const Number y = ray.y / depth;
  const Number r2 = x * x + y * y;
  const Number radial = Real(1) + r2 * (k1 + k2 * r2);
  const Number xy = Real(2) * (x * y);
  const Number distorted_x = x * radial + p1 * xy + p2 * (r2 + Real(2) * (x * x));
  const Number distorted_y = y * radial + p1 * (r2 + Real(2) * (y * y)) + p2 * xy;
  return {distorted_x + skew * distorted_y, distorted_y, depth.value > 0};
}

// Usenko, Demmel and Cremers, equations 40 to 43.
template <class Real>
auto ExactLens<Real>::double_sphere(const Ray& ray) const -> Image {
  const Real xi = k_[0];
  const Real alpha = k_[1];
  const Number k = xi + ray.z;
  const Number depth = alpha * sqrt(ray.x * ray.x + ray.y * ray.y + k * k) + (1 - alpha) * k;
  return {ray.x / depth, ray.y / depth, depth.value > 0};
}

// Khomutenko, Garcia and Martinet, equation 9.
template <class Real>
auto ExactLens<Real>::extended_unified(const Ray& ray) const -> Image {
  const Real alpha = k_[0];
  const Real beta = k_[1];
  const Number depth = alpha * sqrt(beta * (ray.x * ray.x + ray.y * ray.y) + ray.z * ray.z) + (1 - alpha) * ray.z;
  return {ray.x / depth, ray.y / depth, depth.value > 0};
}

template <class Real>
auto ExactLens<Real>::flat(const Vec2& point) const -> Image {
  switch (model_) {
    case LensModel::brown_conrady:
      return brown_conrady(point);
    case LensModel::kannala_brandt:
      return kannala_brandt(point);
    case LensModel::omnidirectional:
      return omnidirectional(ray_by_angle(point));
    case LensModel::double_sphere:
      return double_sphere(ray_by_angle(point));
    case LensModel::extended_unified:
      return extended_unified(ray_by_angle(point));
    case LensModel::equirectangular:
      return {Number{point.x, 1, 0}, Number{point.y, 0, 1}, true};
  }
  return {};
}

template <class Real>
auto ExactLens<Real>::image(const Vec2& point) const -> Image {
  const Image at = flat(point);
  return {center_px_.x + focal_px_.x * at.x, center_px_.y + focal_px_.y * at.y, at.is_sane};
}

template <class Real>
bool ExactLens<Real>::folds_at(Real radius) const {
  for (int i = 0; i < kDirections; ++i) {
    const Real phi = 2 * std::numbers::pi_v<Real> * i / kDirections;
    const Image at = image({radius * std::cos(phi), radius * std::sin(phi)});
    const Real determinant = at.x.by_x * at.y.by_y - at.x.by_y * at.y.by_x;
    if (!at.is_sane || !(determinant > 0)) return true;
  }
  return false;
}

template <class Real>
Real ExactLens<Real>::first_fold() const {
  const bool is_straight = (!is_by_angle_ || model_ == LensModel::kannala_brandt) &&
                           std::all_of(k_.begin(), k_.end(), [](Real k) { return k == 0; });
  if (is_straight) return is_by_angle_ ? std::numbers::pi_v<Real> : std::numeric_limits<Real>::infinity();
  const Real widest_rad = is_by_angle_ ? std::numbers::pi_v<Real> : std::numbers::pi_v<Real> / 2;
  const auto radius_at = [&](Real angle_rad) { return is_by_angle_ ? angle_rad : std::tan(angle_rad); };
  Real good = 0;
  Real bad = widest_rad;
  for (int i = 1; i < kRadii; ++i) {
    bad = widest_rad * i / kRadii;
    if (folds_at(radius_at(bad))) break;
    good = bad;
    bad = widest_rad;
  }
  if (bad == widest_rad) return is_by_angle_ ? widest_rad : radius_at(good);
  for (int step = 0; step < 60; ++step) {
    const Real middle = (good + bad) / 2;
    (folds_at(radius_at(middle)) ? bad : good) = middle;
  }
  return radius_at(good);
}

template <class Real>
auto ExactLens<Real>::known_points() const -> std::vector<Known> {
  constexpr int kRings = 64;
  constexpr int kSpokes = 48;
  const Real widest_rad = std::min(field_angle_rad(), is_by_angle_ ? std::numbers::pi_v<Real> : Real(kWidest));
  std::vector<Known> known;
  for (int ring = 0; ring < kRings; ++ring)
    for (int spoke = 0; spoke < (ring == 0 ? 1 : kSpokes); ++spoke) {
      const Real angle_rad = widest_rad * ring / kRings;
      const Real radius = is_by_angle_ ? angle_rad : std::tan(angle_rad);
      const Real phi = 2 * std::numbers::pi_v<Real> * spoke / kSpokes;
      const Vec2 point(radius * std::cos(phi), radius * std::sin(phi));
      const Image at = image(point);
      known.push_back({point, {at.x.value, at.y.value}});
    }
  return known;
}

template <class Real>
auto ExactLens<Real>::pixel(const Vec3& p_in_camera) const -> std::optional<Vec2> {
  const Real z = p_in_camera.x;
  Vec2 point(p_in_camera.y, p_in_camera.z);
  if (is_sphere_) {
    const Real length = glm::length(p_in_camera);
    if (!(length > 0)) return std::nullopt;
    const Real level = std::sqrt(p_in_camera.x * p_in_camera.x + p_in_camera.y * p_in_camera.y);
    const Real longitude = level > 0 ? std::acos(std::clamp(p_in_camera.x / level, Real(-1), Real(1))) : Real(0);
    point = {p_in_camera.y < 0 ? -longitude : longitude,
             std::acos(std::clamp(-p_in_camera.z / length, Real(-1), Real(1))) - std::numbers::pi_v<Real> / 2};
  } else if (is_by_angle_) {
    const Real off_axis = glm::length(point);
    if (off_axis == 0 && !(z > 0)) return std::nullopt;
    if (off_axis > 0) point *= std::atan2(off_axis, z) / off_axis;
  } else {
    if (!(z > 0)) return std::nullopt;
    point /= z;
  }
  if (!(glm::length(point) < field_radius_)) return std::nullopt;
  const Image at = image(point);
  const Vec2 result(at.x.value, at.y.value);
  if (!at.is_sane || !std::isfinite(result.x) || !std::isfinite(result.y)) return std::nullopt;
  return result;
}

template <class Real>
auto ExactLens<Real>::plane_point_near(const Vec2& pixel_px, const Vec2& guess) const -> std::optional<Vec2> {
  constexpr int kMaxSteps = 60;
  const Real enough = 64 * std::numeric_limits<Real>::epsilon();
  Vec2 point = guess;
  Real last = std::numeric_limits<Real>::infinity();
  Vec2 step(0);
  for (int i = 0; i < kMaxSteps; ++i) {
    const Image at = image(point);
    const Vec2 apart(at.x.value - pixel_px.x, at.y.value - pixel_px.y);
    const Real size = glm::length(apart);
    const bool is_better = at.is_sane && size < last && glm::length(point) < field_radius_;
    if (!is_better && last < Real(1e-3) && glm::length(step) < 1e-8) return point + step;  // rounding is left
    if (!is_better) {
      if (i == 0) return std::nullopt;
      step /= Real(2);  // back to half way
      point += step;
      continue;
    }
    last = size;
    const Real determinant = at.x.by_x * at.y.by_y - at.x.by_y * at.y.by_x;
    if (!(determinant > 0)) return std::nullopt;
    step = Vec2(at.y.by_y * apart.x - at.x.by_y * apart.y, at.x.by_x * apart.y - at.y.by_x * apart.x) / determinant;
    point -= step;
    if (glm::length(step) > enough * (1 + glm::length(point))) continue;
    if (!(glm::length(point) < field_radius_)) return std::nullopt;
    return point;
  }
  return std::nullopt;
}

template <class Real>
auto ExactLens<Real>::plane_point(const Vec2& pixel_px) const -> std::optional<Vec2> {
  const auto apart = [&](const Known& k) {
    const Vec2 between = k.pixel_px - pixel_px;
    return glm::dot(between, between);
  };
  const auto nearest = std::min_element(known_.begin(), known_.end(),
                                        [&](const Known& a, const Known& b) { return apart(a) < apart(b); });
  return plane_point_near(pixel_px, nearest->point);
}

template <class Real>
auto ExactLens<Real>::ray_of(const Vec2& plane_point) const -> Vec3 {
  const Real radius = glm::length(plane_point);
  if (is_sphere_) {
    const Real colatitude = plane_point.y + std::numbers::pi_v<Real> / 2;
    return {std::sin(colatitude) * std::cos(plane_point.x), std::sin(colatitude) * std::sin(plane_point.x),
            -std::cos(colatitude)};
  }
  if (!is_by_angle_) return Vec3(1, plane_point.x, plane_point.y) / std::sqrt(1 + radius * radius);
  const Vec2 across = radius > 0 ? plane_point * (std::sin(radius) / radius) : plane_point;
  return {std::cos(radius), across.x, across.y};
}

template <class Real>
auto ExactLens<Real>::ray(const Vec2& pixel_px) const -> std::optional<Vec3> {
  const std::optional<Vec2> point = plane_point(pixel_px);
  if (!point) return std::nullopt;
  return ray_of(*point);
}

template class ExactLens<double>;
template class ExactLens<long double>;

}  // namespace sigs::truth
