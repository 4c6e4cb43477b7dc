// SPDX-License-Identifier: MIT
#include "camera/lens.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/glm.hpp>
#include <limits>
#include <numbers>
#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <utility>

#include "base/pose.h"
#include "camera/distortion_models.h"

namespace sigs::distortion {

namespace {

// The radius alone is solved for: enough for models, and parts of models, that keep circles.
template <class Model>
std::optional<glm::dvec2> radially_undistorted(const Model& model, const Field& field, const glm::dvec2& point) {
  const double distance = glm::length(point);
  if (distance == 0) return point;
  if (!std::isfinite(field.radius)) return point;  // no distortion, no limit
  const auto radial = [&model](double r) { return model.radial(r); };
  const std::optional<double> r = increasing_inverse(radial, distance, field.radius);
  if (!r) return std::nullopt;
  return point * (*r / distance);
}

// Where Newton's method starts: at the radial answer, or just inside the rim.
glm::dvec2 first_guess(const BrownConrady& model, const Field& field, const glm::dvec2& point) {
  constexpr double kInside = 0.98;
  const std::optional<glm::dvec2> radial = radially_undistorted(model, field, point);
  if (radial && glm::length(*radial) < kInside * field.radius) return *radial;
  return glm::normalize(point) * (kInside * field.radius);
}

// Newton's method on distorted(p) = point. A step is halved until it stays in the field and reduces the error. The
// method ends where no step reduces it, which at a root is the last digit.
std::optional<glm::dvec2> newton(const BrownConrady& model, const Field& field, const glm::dvec2& point, glm::dvec2 p) {
  constexpr int kMaxSteps = 100;
  constexpr int kMaxHalvings = 30;
  constexpr double kGoodEnough = 1e-11;  // Lens::ray checks the result again, in pixels
  glm::dvec2 error = model.distorted_before_tilt(p) - point;
  for (int step = 0; step < kMaxSteps && error != glm::dvec2{0, 0}; ++step) {
    const glm::dmat2 jacobian = model.jacobian_before_tilt(p);
    if (!(glm::determinant(jacobian) > 0)) break;
    glm::dvec2 move = -(glm::inverse(jacobian) * error);
    bool is_better = false;
    for (int halving = 0; halving < kMaxHalvings && !is_better; ++halving, move *= 0.5) {
      const glm::dvec2 candidate = p + move;
      if (!(glm::length(candidate) < field.radius)) continue;
      const glm::dvec2 candidate_error = model.distorted_before_tilt(candidate) - point;
      is_better = glm::dot(candidate_error, candidate_error) < glm::dot(error, error);
      if (is_better) p = candidate, error = candidate_error;
    }
    if (!is_better) break;
  }
  if (!(glm::length(error) <= kGoodEnough * (1 + glm::length(point)))) return std::nullopt;
  return p;
}

// True where the point lies outside the distorted rim by more than the polygon of the rim deviates from the curve: then
// no p of the field is distorted to it. Even-odd rule: a ray from a point outside crosses the polygon an even number of
// times.
bool clearly_outside(std::span<const glm::dvec2> rim, const glm::dvec2& point) {
  constexpr double kMargin = 1.001;  // 360 corners cut off 4e-5 of a circle's radius
  int crossings = 0;
  for (std::size_t i = 0; i < rim.size(); ++i) {
    const glm::dvec2 a = rim[i] * kMargin - point;
    const glm::dvec2 b = rim[(i + 1) % rim.size()] * kMargin - point;
    if ((a.y > 0) == (b.y > 0)) continue;
    const double x = a.x - a.y * (b.x - a.x) / (b.y - a.y);
    if (x > 0) ++crossings;
  }
  return crossings % 2 == 0;
}

// Tries Newton's method from the best sample of each of many circles, spread evenly by angle from the axis.
std::optional<glm::dvec2> searched(const BrownConrady& model, const Field& field, const glm::dvec2& point) {
  constexpr int kRings = 48;
  constexpr int kSpokes = 96;
  const double widest_rad = std::atan(field.radius);
  for (int ring = kRings; ring > 0; --ring) {
    const double r = std::tan(widest_rad * (ring - 0.01) / kRings);
    glm::dvec2 best{0, 0};
    double best_error = std::numeric_limits<double>::infinity();
    for (int spoke = 0; spoke < kSpokes; ++spoke) {
      const double phi = 2 * std::numbers::pi * spoke / kSpokes;
      const glm::dvec2 p = r * glm::dvec2{std::cos(phi), std::sin(phi)};
      const double error = glm::length(model.distorted_before_tilt(p) - point);
      if (error < best_error) best = p, best_error = error;
    }
    if (const auto found = newton(model, field, point, best)) return found;
  }
  return std::nullopt;
}

// The p within the field that a model distorts to a given point, to the last digits that the arithmetic holds; nothing
// where there is none. For radial models one number is solved for. Where tangential or prism terms couple x and y,
// damped Newton's method in the plane starts from the radial answer; where it fails and the point is not clearly
// outside the distorted rim of the field, the whole field is searched.
std::optional<glm::dvec2> undistorted(const BrownConrady& model, const Field& field,
                                      const glm::dvec2& distorted_point) {
  const std::optional<glm::dvec2> flat = model.untilted(distorted_point);
  if (!flat) return std::nullopt;
  if (model.radial_only) return radially_undistorted(model, field, *flat);
  if (*flat == glm::dvec2{0, 0}) return flat;
  if (const auto found = newton(model, field, *flat, first_guess(model, field, *flat))) return found;
  if (clearly_outside(field.edge, *flat)) return std::nullopt;
  return searched(model, field, *flat);
}

std::optional<glm::dvec2> undistorted(const KannalaBrandt& model, const Field& field,
                                      const glm::dvec2& distorted_point) {
  return radially_undistorted(model, field, distorted_point);
}

// Over a pole as far as to the other one.
std::optional<glm::dvec2> undistorted(const Equirectangular& /*model*/, const Field& /*field*/,
                                      const glm::dvec2& distorted_point) {
  if (!(std::abs(distorted_point.y) <= 1.5 * std::numbers::pi)) return std::nullopt;
  return distorted_point;
}

}  // namespace
}  // namespace sigs::distortion

namespace sigs {
namespace {

bool is_finite(const glm::dvec2& v) {
  return std::isfinite(v.x) && std::isfinite(v.y);
}
bool is_finite(const glm::dvec3& v) {
  return is_finite(glm::dvec2{v}) && std::isfinite(v.z);
}

constexpr std::size_t kBrownConradyCounts[] = {0, 4, 5, 8, 12, 14};
constexpr std::size_t kKannalaBrandtCounts[] = {4};
constexpr std::size_t kEquirectangularCounts[] = {0};

struct ModelTraits {
  const char* name;
  std::span<const std::size_t> counts;  // of coefficients
  const char* counts_text;
};

// In the order of LensModel.
constexpr std::array<ModelTraits, 3> kModelTraits{{
    {"Brown-Conrady", kBrownConradyCounts, "0, 4, 5, 8, 12 or 14 distortion"},
    {"Kannala-Brandt", kKannalaBrandtCounts, "4 fisheye"},
    {"equirectangular", kEquirectangularCounts, "0 equirectangular"},
}};

const ModelTraits& traits_of(LensModel model) {
  return kModelTraits.at(static_cast<std::size_t>(model));
}

// What is wrong with the parameters; empty where they are valid.
std::string fault(const LensParameters& p) {
  const std::size_t count = p.coefficients.size();
  const ModelTraits& traits = traits_of(p.model);
  if (std::ranges::find(traits.counts, count) == traits.counts.end())
    return fmt::format("expected {} coefficients, found {}", traits.counts_text, count);
  if (!is_finite({p.fx, p.fy}) || !is_finite({p.cx, p.cy})) return "focal length and principal point must be finite";
  if (!(p.fx > 0 && p.fy > 0)) return "the focal length must be positive";
  if (!std::ranges::all_of(p.coefficients, [](double c) { return std::isfinite(c); }))
    return "distortion coefficients must be finite";
  const auto too_tilted = [](double tau_rad) { return std::abs(tau_rad) >= std::numbers::pi / 2; };
  if (count == 14 && (too_tilted(p.coefficients[12]) || too_tilted(p.coefficients[13])))
    return "the sensor's tilt (coefficients 13 and 14, radians) must be less than pi / 2";
  return {};
}

}  // namespace

const char* name_of(LensModel model) {
  return traits_of(model).name;
}

Lens::Lens(LensParameters parameters, Model model)
    : parameters_(std::move(parameters)),
      model_(std::move(model)),
      field_(std::visit([](const auto& m) { return distortion::valid_field(m); }, model_)),
      middle_px_(parameters_.cx) {}

Result<Lens> Lens::make(LensParameters parameters) {
  if (std::string wrong = fault(parameters); !wrong.empty()) return fail("", std::move(wrong));
  Model model = model_of(parameters);
  return Lens(std::move(parameters), std::move(model));
}

Lens::Model Lens::model_of(const LensParameters& parameters) {
  switch (parameters.model) {
    case LensModel::brown_conrady:
      return distortion::BrownConrady::of(parameters.coefficients);
    case LensModel::kannala_brandt:
      return distortion::KannalaBrandt::of(parameters.coefficients);
    case LensModel::equirectangular:
      return distortion::Equirectangular::of(parameters.coefficients);
  }
  return {};
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
  if (parameters_.model == LensModel::equirectangular) return result;  // a closed form, and columns repeat
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
        if constexpr (std::is_same_v<std::decay_t<decltype(model)>, distortion::Equirectangular>)
          return std::max(std::min(focal().x * stretch.x, focal().x * 2 * focal().y), focal().y);
        const glm::dmat2 jacobian = model.jacobian(*point);
        return distortion::largest_singular_value(
            {focal() * (jacobian * along) * stretch.x, focal() * (jacobian * across) * stretch.y});
      },
      model_);
}

double Lens::valid_angle_rad() const {
  switch (parameters_.model) {
    case LensModel::brown_conrady:
      return std::atan(field_.radius);
    case LensModel::kannala_brandt:
      return field_.radius;
    case LensModel::equirectangular:
      return std::numbers::pi;
  }
  return 0;
}

bool Lens::is_pinhole() const {
  return parameters_.model == LensModel::brown_conrady &&
         std::ranges::all_of(parameters_.coefficients, [](double c) { return c == 0; });
}

double Lens::period_px() const {
  return parameters_.model == LensModel::equirectangular ? 2 * std::numbers::pi * parameters_.fx : 0;
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
