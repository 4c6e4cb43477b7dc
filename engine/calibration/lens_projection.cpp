// SPDX-License-Identifier: MIT
#include "calibration/lens_projection.h"

#include <array>
#include <cmath>
#include <span>

namespace sigs {

namespace {

constexpr int kVariables = 3 + kMaxIntrinsics;  // of the point, of the lens

// A number with its derivatives by all variables (forward differentiation).
struct Jet {
  double value = 0;
  Eigen::Matrix<double, kVariables, 1> by = Eigen::Matrix<double, kVariables, 1>::Zero();

  Jet() = default;
  Jet(double number) : value(number) {}
  static Jet variable(double number, int index) {
    Jet jet(number);
    jet.by[index] = 1;
    return jet;
  }
};

Jet with(double value, const Eigen::Matrix<double, kVariables, 1>& by) {
  Jet jet(value);
  jet.by = by;
  return jet;
}
Jet operator+(const Jet& a, const Jet& b) {
  return with(a.value + b.value, a.by + b.by);
}
Jet operator*(const Jet& a, const Jet& b) {
  return with(a.value * b.value, a.by * b.value + b.by * a.value);
}
Jet operator/(const Jet& a, const Jet& b) {
  const double quotient = a.value / b.value;
  return with(quotient, (a.by - b.by * quotient) / b.value);
}
Jet sqrt(const Jet& a) {
  const double root = std::sqrt(a.value);
  return with(root, a.by / (2 * root));
}
Jet atan2(const Jet& y, const Jet& x) {
  const double squares = y.value * y.value + x.value * x.value;
  return with(std::atan2(y.value, x.value), (y.by * x.value - x.by * y.value) / squares);
}
double value_of(double number) {
  return number;
}
double value_of(const Jet& number) {
  return number.value;
}

template <class T>
struct Plane {
  T x, y;
};

// a0 + a1 x + a2 x^2 + ...
template <class T>
T polynomial(std::span<const T> a, const T& x) {
  T sum = a.back();
  for (std::size_t i = a.size() - 1; i-- > 0;) sum = a[i] + x * sum;
  return sum;
}

// OpenCV's distortion with k1 k2 p1 p2 k3 and, where there are eight, k4 k5 k6. Nothing behind the camera.
template <class T>
std::optional<Plane<T>> brown_conrady(std::span<const T> k, const std::array<T, 3>& p) {
  if (!(value_of(p[2]) > 1e-9)) return std::nullopt;
  const T x = p[0] / p[2];
  const T y = p[1] / p[2];
  if (k.empty()) return Plane<T>{x, y};
  const T r2 = x * x + y * y;
  T radial = polynomial<T>(std::array<T, 4>{T(1), k[0], k[1], k[4]}, r2);
  if (k.size() == 8) {
    const T denominator = polynomial<T>(std::array<T, 4>{T(1), k[5], k[6], k[7]}, r2);
    if (!(value_of(denominator) > 1e-6)) return std::nullopt;
    radial = radial / denominator;
  }
  const T two_xy = T(2) * x * y;
  return Plane<T>{x * radial + k[2] * two_xy + k[3] * (r2 + T(2) * x * x),
                  y * radial + k[2] * (r2 + T(2) * y * y) + k[3] * two_xy};
}

// OpenCV's fisheye model. The angle goes up to 180 degrees.
template <class T>
std::optional<Plane<T>> kannala_brandt(std::span<const T> k, const std::array<T, 3>& p) {
  using std::atan2;
  using std::sqrt;
  const T r2 = p[0] * p[0] + p[1] * p[1];
  if (value_of(r2) < 1e-18 * value_of(p[2]) * value_of(p[2])) {
    if (!(value_of(p[2]) > 0)) return std::nullopt;
    return Plane<T>{p[0] / p[2], p[1] / p[2]};
  }
  if (!(value_of(r2) > 0)) return std::nullopt;
  const T r = sqrt(r2);
  const T angle = atan2(r, p[2]);
  const T scale = angle * polynomial<T>(std::array<T, 5>{T(1), k[0], k[1], k[2], k[3]}, angle * angle) / r;
  return Plane<T>{p[0] * scale, p[1] * scale};
}

template <class T>
std::optional<Plane<T>> pixel(FitModel model, std::span<const T> all, const std::array<T, 3>& p) {
  const std::span<const T> k = all.subspan(4);
  const auto distorted = model == FitModel::kannala_brandt ? kannala_brandt<T>(k, p) : brown_conrady<T>(k, p);
  if (!distorted) return std::nullopt;
  return Plane<T>{all[0] * distorted->x + all[2], all[1] * distorted->y + all[3]};
}

}  // namespace

const char* name_of(FitModel model) {
  switch (model) {
    case FitModel::pinhole:
      return "pinhole";
    case FitModel::brown_conrady_5:
      return "Brown-Conrady 5";
    case FitModel::kannala_brandt:
      return "Kannala-Brandt";
    case FitModel::brown_conrady_8:
      return "Brown-Conrady 8";
  }
  return "";
}

int intrinsic_count(FitModel model) {
  switch (model) {
    case FitModel::pinhole:
      return 4;
    case FitModel::brown_conrady_5:
      return 9;
    case FitModel::kannala_brandt:
      return 8;
    case FitModel::brown_conrady_8:
      return 12;
  }
  return 4;
}

LensParameters lens_of(FitModel model, const Intrinsics& intrinsics) {
  return {.model = model == FitModel::kannala_brandt ? LensModel::kannala_brandt : LensModel::brown_conrady,
          .fx = intrinsics[0],
          .fy = intrinsics[1],
          .cx = intrinsics[2],
          .cy = intrinsics[3],
          .coefficients = std::vector<double>(intrinsics.data() + 4, intrinsics.data() + intrinsics.size())};
}

std::optional<ProjectedPoint> projected(FitModel model, const Intrinsics& intrinsics,
                                        const Eigen::Vector3d& p_in_optical) {
  std::array<Jet, kMaxIntrinsics> lens;
  const int count = intrinsic_count(model);
  for (int i = 0; i < count; ++i) lens[i] = Jet::variable(intrinsics[i], 3 + i);
  std::array<Jet, 3> point;
  for (int i = 0; i < 3; ++i) point[i] = Jet::variable(p_in_optical[i], i);
  const auto at = pixel<Jet>(model, std::span<const Jet>(lens).first(count), point);
  if (!at) return std::nullopt;
  ProjectedPoint result;
  result.at_px = {at->x.value, at->y.value};
  result.by_point << at->x.by.head<3>().transpose(), at->y.by.head<3>().transpose();
  result.by_intrinsics << at->x.by.tail<kMaxIntrinsics>().transpose(), at->y.by.tail<kMaxIntrinsics>().transpose();
  if (!result.at_px.allFinite() || !result.by_point.allFinite() || !result.by_intrinsics.allFinite())
    return std::nullopt;
  return result;
}

std::optional<Eigen::Vector2d> pixel_of(FitModel model, const Intrinsics& intrinsics,
                                        const Eigen::Vector3d& p_in_optical) {
  const std::array<double, 3> point{p_in_optical[0], p_in_optical[1], p_in_optical[2]};
  const std::span<const double> lens(intrinsics.data(), static_cast<std::size_t>(intrinsic_count(model)));
  const auto at = pixel<double>(model, lens, point);
  if (!at || !std::isfinite(at->x) || !std::isfinite(at->y)) return std::nullopt;
  return Eigen::Vector2d(at->x, at->y);
}

}  // namespace sigs
