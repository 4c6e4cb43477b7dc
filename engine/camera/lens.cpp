// SPDX-License-Identifier: MIT
#include "camera/lens.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <utility>

#include "base/pose.h"
#include "camera/undistort.h"

namespace sigs {
namespace {

bool is_finite(const glm::dvec2& v) {
  return std::isfinite(v.x) && std::isfinite(v.y);
}
bool is_finite(const glm::dvec3& v) {
  return is_finite(glm::dvec2{v}) && std::isfinite(v.z);
}

bool has_count(LensModel model, std::size_t count) {
  constexpr std::array<std::size_t, 6> kCounts{0, 4, 5, 8, 12, 14};
  if (model == LensModel::kannala_brandt) return count == 4;
  return std::ranges::find(kCounts, count) != kCounts.end();
}

// What is wrong with the parameters; empty where nothing is.
std::string complaint(const LensParameters& p) {
  const std::size_t count = p.coefficients.size();
  if (!has_count(p.model, count)) {
    const bool fisheye = p.model == LensModel::kannala_brandt;
    return "expected " + std::string(fisheye ? "4 fisheye" : "0, 4, 5, 8, 12 or 14 distortion") +
           " coefficients, found " + std::to_string(count);
  }
  if (!is_finite({p.fx, p.fy}) || !is_finite({p.cx, p.cy})) return "focal length and principal point must be finite";
  if (!(p.fx > 0 && p.fy > 0)) return "the focal length must be positive";
  if (!std::ranges::all_of(p.coefficients, [](double c) { return std::isfinite(c); }))
    return "distortion coefficients must be finite";
  const auto too_tilted = [](double tau_rad) { return std::abs(tau_rad) >= std::numbers::pi / 2; };
  if (count == 14 && (too_tilted(p.coefficients[12]) || too_tilted(p.coefficients[13])))
    return "the sensor's tilt (coefficients 13 and 14, radians) must be less than pi / 2";
  return {};
}

// Largest singular value of a 2x2 matrix.
double largest_stretch(const glm::dmat2& m) {
  const double first = glm::dot(m[0], m[0]);
  const double second = glm::dot(m[1], m[1]);
  const double between = glm::dot(m[0], m[1]);
  return std::sqrt((first + second + std::hypot(first - second, 2 * between)) / 2);
}

}  // namespace

Lens::Lens(LensParameters parameters, Model model)
    : parameters_(std::move(parameters)),
      model_(std::move(model)),
      field_(std::visit([](const auto& m) { return distortion::valid_field(m); }, model_)) {}

Result<Lens> Lens::make(LensParameters parameters) {
  if (std::string wrong = complaint(parameters); !wrong.empty()) return fail("", std::move(wrong));
  Model model = parameters.model == LensModel::kannala_brandt
                    ? Model{distortion::KannalaBrandt::of(parameters.coefficients)}
                    : Model{distortion::BrownConrady::of(parameters.coefficients)};
  return Lens(std::move(parameters), std::move(model));
}

// Place on the model's undistorted plane, if it lies within the field.
std::optional<glm::dvec2> Lens::plane_point(const glm::dvec3& p_in_camera) const {
  if (!is_finite(p_in_camera)) return std::nullopt;
  const glm::dvec3 p_optical = optical_of(p_in_camera);
  const auto point = std::visit([&](const auto& model) { return model.plane_of(p_optical); }, model_);
  if (!point || !(glm::length(*point) < field_.radius)) return std::nullopt;
  return point;
}

std::optional<glm::dvec2> Lens::pixel(const glm::dvec3& p_in_camera) const {
  const std::optional<glm::dvec2> point = plane_point(p_in_camera);
  if (!point) return std::nullopt;
  const glm::dvec2 distorted = std::visit([&](const auto& model) { return model.distorted(*point); }, model_);
  const glm::dvec2 result = distorted * focal() + center();
  if (!is_finite(result)) return std::nullopt;
  return result;
}

// The forward map must return to the pixel: within 1e-9 px or, where a step of the doubles that hold the pixel or the
// ray is worth more than that, within some such steps.
bool Lens::comes_back(const glm::dvec3& ray, const glm::dvec2& pixel_px) const {
  constexpr double kTolerancePx = 1e-9;
  constexpr double kSteps = 64 * std::numeric_limits<double>::epsilon();
  const std::optional<glm::dvec2> back = pixel(ray);
  if (!back) return false;
  const glm::dvec2 apart = *back - pixel_px;
  const double apart_px = std::hypot(apart.x, apart.y);  // unlike glm::length, finite for 1e300
  if (apart_px <= kTolerancePx) return true;
  const double largest_px = std::max({std::abs(pixel_px.x), std::abs(pixel_px.y), pixels_per_radian(ray)});
  return apart_px <= kSteps * largest_px;
}

std::optional<glm::dvec3> Lens::ray(const glm::dvec2& pixel_px) const {
  if (!is_finite(pixel_px)) return std::nullopt;
  const glm::dvec2 distorted = (pixel_px - center()) / focal();
  const auto optical_ray = std::visit(
      [&](const auto& model) -> std::optional<glm::dvec3> {
        const std::optional<glm::dvec2> point = distortion::undistorted(model, field_, distorted);
        if (!point) return std::nullopt;
        return model.ray_of(*point);
      },
      model_);
  if (!optical_ray) return std::nullopt;
  const glm::dvec3 result = camera_of(*optical_ray);
  if (!comes_back(result, pixel_px)) return std::nullopt;
  return result;
}

double Lens::pixels_per_radian(const glm::dvec3& direction_in_camera) const {
  const std::optional<glm::dvec2> point = plane_point(direction_in_camera);
  if (!point) return 0;
  const double r = glm::length(*point);
  const glm::dvec2 along = r > 0 ? *point / r : glm::dvec2{1, 0};
  const glm::dvec2 across{-along.y, along.x};
  return std::visit(
      [&](const auto& model) {
        const glm::dvec2 stretch = model.stretch(*point);
        const glm::dmat2 jacobian = model.jacobian(*point);
        return largest_stretch({focal() * (jacobian * along) * stretch.x, focal() * (jacobian * across) * stretch.y});
      },
      model_);
}

double Lens::valid_angle_rad() const {
  return std::holds_alternative<distortion::BrownConrady>(model_) ? std::atan(field_.radius) : field_.radius;
}

bool Lens::is_pinhole() const {
  return parameters_.model == LensModel::brown_conrady &&
         std::ranges::all_of(parameters_.coefficients, [](double c) { return c == 0; });
}

}  // namespace sigs
