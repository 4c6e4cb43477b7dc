// SPDX-License-Identifier: MIT
#include "calibration/lens_fit.h"

#include <array>
#include <cmath>
#include <numeric>
#include <span>

namespace sigs {

namespace {

struct FitModelTraits {
  const char* name;
  int intrinsics;
};

// In the order of FitModel.
constexpr std::array<FitModelTraits, 4> kFitModels{
    {{"pinhole", 4}, {"Brown-Conrady 5", 9}, {"Kannala-Brandt", 8}, {"Brown-Conrady 8", 12}}};

// A point on the plane one focal length ahead, as the lens distorts it.
struct Distorted {
  glm::dvec2 at;
  std::array<glm::dvec3, 2> by_point;
  std::array<std::array<double, 8>, 2> by_coefficients{};
};

// OpenCV's distortion with k1 k2 p1 p2 k3 and, where there are eight, k4 k5 k6. Nothing behind the camera.
std::optional<Distorted> brown_conrady(std::span<const double> k, const glm::dvec3& p) {
  if (!(p.z > 1e-9)) return std::nullopt;
  const double x = p.x / p.z, y = p.y / p.z;
  Distorted d{.at = {x, y}};
  double by_x = 1, by_y = 1, mixed = 0;  // of the first by x, of the second by y, of either by the other
  if (!k.empty()) {
    const double r2 = x * x + y * y, r4 = r2 * r2, r6 = r4 * r2;
    const double denominator = k.size() == 8 ? 1 + k[5] * r2 + k[6] * r4 + k[7] * r6 : 1;
    if (!(denominator > 1e-6)) return std::nullopt;
    const double radial = (1 + k[0] * r2 + k[1] * r4 + k[4] * r6) / denominator;
    const double slope_above = k[0] + 2 * k[1] * r2 + 3 * k[4] * r4;
    const double slope_below = k.size() == 8 ? k[5] + 2 * k[6] * r2 + 3 * k[7] * r4 : 0;
    const double by_r2 = (slope_above - radial * slope_below) / denominator;
    const double p1 = k[2], p2 = k[3];
    d.at = {x * radial + 2 * p1 * x * y + p2 * (r2 + 2 * x * x), y * radial + p1 * (r2 + 2 * y * y) + 2 * p2 * x * y};
    by_x = radial + 2 * x * x * by_r2 + 2 * p1 * y + 6 * p2 * x;
    by_y = radial + 2 * y * y * by_r2 + 6 * p1 * y + 2 * p2 * x;
    mixed = 2 * x * y * by_r2 + 2 * p1 * x + 2 * p2 * y;
    for (std::size_t axis = 0; axis < 2; ++axis) {
      const double above = (axis == 0 ? x : y) / denominator, below = -above * radial;
      d.by_coefficients[axis] = {above * r2,
                                 above * r4,
                                 axis == 0 ? 2 * x * y : r2 + 2 * y * y,
                                 axis == 0 ? r2 + 2 * x * x : 2 * x * y,
                                 above * r6,
                                 below * r2,
                                 below * r4,
                                 below * r6};
    }
  }
  d.by_point = {glm::dvec3(by_x, mixed, -by_x * x - mixed * y) / p.z,
                glm::dvec3(mixed, by_y, -mixed * x - by_y * y) / p.z};
  return d;
}

// OpenCV's fisheye model. The angle goes up to 180 degrees.
std::optional<Distorted> kannala_brandt(std::span<const double> k, const glm::dvec3& p) {
  const double r2 = p.x * p.x + p.y * p.y;
  if (r2 < 1e-18 * p.z * p.z) return brown_conrady({}, p);
  if (!(r2 > 0)) return std::nullopt;
  const double r = std::sqrt(r2), angle = std::atan2(r, p.z), a2 = angle * angle;
  const double distorted = angle * (1 + a2 * (k[0] + a2 * (k[1] + a2 * (k[2] + a2 * k[3]))));
  const double by_angle = 1 + a2 * (3 * k[0] + a2 * (5 * k[1] + a2 * (7 * k[2] + a2 * 9 * k[3])));
  const double distance2 = r2 + p.z * p.z;
  const double scale = distorted / r;
  const double scale_by_r = (by_angle * p.z / distance2 - scale) / r;
  const double scale_by_z = -by_angle / distance2;
  Distorted d{.at = {p.x * scale, p.y * scale}};
  for (int i = 0; i < 2; ++i) {
    const auto axis = static_cast<std::size_t>(i);
    d.by_point[axis] = p[i] * glm::dvec3(scale_by_r * p.x / r, scale_by_r * p.y / r, scale_by_z);
    d.by_point[axis][i] += scale;
    double power = angle;
    for (std::size_t n = 0; n < 4; ++n) d.by_coefficients[axis][n] = p[i] / r * (power *= a2);
  }
  return d;
}

std::optional<Distorted> distorted(FitModel model, const Intrinsics& intrinsics, const glm::dvec3& p) {
  const std::span<const double> k = std::span(intrinsics).subspan(4);
  return model == FitModel::kannala_brandt ? kannala_brandt(k, p) : brown_conrady(k, p);
}

glm::dvec2 pixel_at(const Intrinsics& intrinsics, const glm::dvec2& at) {
  return {intrinsics[0] * at.x + intrinsics[2], intrinsics[1] * at.y + intrinsics[3]};
}

}  // namespace

const char* name_of(FitModel model) {
  return kFitModels.at(static_cast<std::size_t>(model)).name;
}

int intrinsic_count(FitModel model) {
  return kFitModels.at(static_cast<std::size_t>(model)).intrinsics;
}

LensParameters lens_of(FitModel model, const Intrinsics& intrinsics) {
  return {.model = model == FitModel::kannala_brandt ? LensModel::kannala_brandt : LensModel::brown_conrady,
          .fx = intrinsics[0],
          .fy = intrinsics[1],
          .cx = intrinsics[2],
          .cy = intrinsics[3],
          .coefficients = std::vector<double>(intrinsics.begin() + 4, intrinsics.end())};
}

std::optional<ProjectedPoint> projected(FitModel model, const Intrinsics& intrinsics, const glm::dvec3& p_in_optical) {
  const std::optional<Distorted> d = distorted(model, intrinsics, p_in_optical);
  if (!d) return std::nullopt;
  ProjectedPoint result{.at_px = pixel_at(intrinsics, d->at)};
  double sum = result.at_px.x + result.at_px.y;
  for (std::size_t axis = 0; axis < 2; ++axis) {
    const double focal_px = intrinsics[axis];
    result.by_point[axis] = focal_px * d->by_point[axis];
    std::array<double, kMaxIntrinsics>& by = result.by_intrinsics[axis];
    by[axis] = d->at[static_cast<int>(axis)];
    by[2 + axis] = 1;
    for (std::size_t i = 4; i < intrinsics.size(); ++i) by[i] = focal_px * d->by_coefficients[axis][i - 4];
    sum = std::accumulate(by.begin(), by.end(), sum + glm::dot(result.by_point[axis], glm::dvec3(1)));
  }
  if (!std::isfinite(sum)) return std::nullopt;
  return result;
}

std::optional<glm::dvec2> pixel_of(FitModel model, const Intrinsics& intrinsics, const glm::dvec3& p_in_optical) {
  const std::optional<Distorted> d = distorted(model, intrinsics, p_in_optical);
  if (!d) return std::nullopt;
  const glm::dvec2 at_px = pixel_at(intrinsics, d->at);
  return std::isfinite(at_px.x) && std::isfinite(at_px.y) ? std::optional(at_px) : std::nullopt;
}

}  // namespace sigs
