// SPDX-License-Identifier: MIT
#include "camera/lens.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <variant>

#include "base/pose.h"
#include "camera/distortion_models.h"

namespace sigs {
namespace {

bool is_finite(const glm::dvec2& v) {
  return std::isfinite(v.x) && std::isfinite(v.y);
}
bool is_finite(const glm::dvec3& v) {
  return is_finite(glm::dvec2{v}) && std::isfinite(v.z);
}

// What is wrong with the parameters; empty where they are valid.
std::string fault(const LensParameters& p) {
  const LensModelTraits& traits = traits_of(p.model);
  const std::size_t count = p.coefficients.size();
  if (std::ranges::find(traits.coefficient_counts, count) == traits.coefficient_counts.end())
    return fmt::format("expected {} coefficients, found {}", traits.coefficients_text, count);
  if (!is_finite({p.fx, p.fy}) || !is_finite({p.cx, p.cy})) return "focal length and principal point must be finite";
  if (!(p.fx > 0 && p.fy > 0)) return "the focal length must be positive";
  if (!std::ranges::all_of(p.coefficients, [](double c) { return std::isfinite(c); }))
    return "distortion coefficients must be finite";
  return std::visit([&](const auto& model) { return model.fault(p.coefficients); },
                    distortion::model_of(p.model, p.coefficients));
}

}  // namespace

double plain_angle_rad(const LensParameters& lens, double distance) {
  return std::visit([&](const auto& model) { return model.angle_rad(distance); },
                    distortion::model_of(lens.model, lens.coefficients));
}

Lens::Lens(LensParameters parameters, distortion::Model model)
    : parameters_(std::move(parameters)),
      model_(std::move(model)),
      field_(std::visit([](const auto& m) { return distortion::valid_field(m); }, model_)),
      middle_px_(parameters_.cx) {}

Result<Lens> Lens::make(LensParameters parameters) {
  if (std::string wrong = fault(parameters); !wrong.empty()) return fail("", std::move(wrong));
  distortion::Model model = distortion::model_of(parameters.model, parameters.coefficients);
  return Lens(std::move(parameters), std::move(model));
}

// The direction's point on the model's undistorted plane, if it lies within the field.
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
  glm::dvec2 result = distorted * focal() + center();
  if (!is_finite(result)) return std::nullopt;
  if (const double period = period_px(); period > 0)
    result.x -= period * std::floor((result.x - middle_px_) / period + 0.5);
  return result;
}

// Whether the forward map leads back to the pixel: within 1e-9 px or, where one step of the doubles that hold the pixel
// or the ray is more than that, within some such steps.
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
  if (period_px() > 0) return result;  // a closed form, and columns repeat
  if (!comes_back(result, pixel_px)) return std::nullopt;
  return result;
}

double Lens::pixels_per_radian(const glm::dvec3& direction_in_camera) const {
  const std::optional<glm::dvec2> point = plane_point(direction_in_camera);
  if (!point) return 0;
  return std::visit([&](const auto& model) { return distortion::magnification(model, *point, focal()); }, model_);
}

double Lens::valid_angle_rad() const {
  return std::visit([&](const auto& model) { return model.angle_rad(field_.radius); }, model_);
}

bool Lens::is_pinhole() const {
  return std::visit([](const auto& model) { return model.kIsPerspective; }, model_) &&
         std::ranges::all_of(parameters_.coefficients, [](double c) { return c == 0; });
}

Lens Lens::pinhole() const {
  const double stretch = std::visit([](const auto& model) { return model.stretch({0, 0}).x; }, model_);
  const auto middle_px = [&](double focal_px) {  // a focal length that a lens can have, however extreme its model
    return std::clamp(focal_px * stretch, std::numeric_limits<double>::min(), std::numeric_limits<double>::max());
  };
  return *make(
      {.fx = middle_px(parameters_.fx), .fy = middle_px(parameters_.fy), .cx = parameters_.cx, .cy = parameters_.cy});
}

double Lens::period_px() const {
  return std::visit([](const auto& model) { return model.kPeriod; }, model_) * parameters_.fx;
}

Lens Lens::around(const glm::dvec3& direction_in_camera) const {
  Lens turned = *this;
  turned.middle_px_ = parameters_.cx;
  if (period_px() > 0)
    if (const std::optional<glm::dvec2> middle = turned.pixel(direction_in_camera)) turned.middle_px_ = middle->x;
  return turned;
}

glm::dvec2 Lens::way(const glm::dvec2& from_px, const glm::dvec2& to_px) const {
  glm::dvec2 apart = to_px - from_px;
  if (const double period = period_px(); period > 0) apart.x -= period * std::floor(apart.x / period + 0.5);
  return apart;
}

}  // namespace sigs
