// SPDX-License-Identifier: MIT
#include <cmath>
#include <glm/glm.hpp>
#include <limits>
#include <numbers>
#include <optional>
#include <span>

#include "camera/distortion_models.h"

namespace sigs::distortion {

namespace {

// The radius alone is solved for: enough for models, and parts of models, that keep circles. A model with distortion
// has a field with a limit (valid_field()).
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

}  // namespace

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

std::optional<glm::dvec2> undistorted(const Omnidirectional& model, const Field& field,
                                      const glm::dvec2& distorted_point) {
  const glm::dvec2 straight{distorted_point.x - model.skew * distorted_point.y, distorted_point.y};
  return undistorted(static_cast<const BrownConrady&>(model), field, straight);
}

std::optional<glm::dvec2> undistorted(const UndistortedPlane& /*model*/, const Field& field,
                                      const glm::dvec2& distorted_point) {
  if (!(glm::length(distorted_point) < field.radius)) return std::nullopt;
  return distorted_point;
}

std::optional<glm::dvec2> undistorted(const Equirectangular& /*model*/, const Field& /*field*/,
                                      const glm::dvec2& distorted_point) {
  if (!(std::abs(distorted_point.y) <= 1.5 * std::numbers::pi)) return std::nullopt;
  return distorted_point;
}

}  // namespace sigs::distortion
