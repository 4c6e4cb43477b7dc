// SPDX-License-Identifier: MIT
#include "camera/undistort.h"

#include <cmath>
#include <limits>
#include <numbers>
#include <span>

namespace sigs::distortion {
namespace {

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

// A good place to start: the radial answer, or just inside the rim.
glm::dvec2 first_guess(const BrownConrady& model, const Field& field, const glm::dvec2& point) {
  constexpr double kInside = 0.98;
  const std::optional<glm::dvec2> radial = radially_undistorted(model, field, point);
  if (radial && glm::length(*radial) < kInside * field.radius) return *radial;
  return glm::normalize(point) * (kInside * field.radius);
}

// Newton's method on distorted(p) = point; a step is halved until it stays in the field and comes nearer. Ends where no
// step comes nearer, which at a root is the last digit.
std::optional<glm::dvec2> newton(const BrownConrady& model, const Field& field, const glm::dvec2& point, glm::dvec2 p) {
  constexpr int kMaxSteps = 100;
  constexpr int kMaxHalvings = 30;
  constexpr double kGoodEnough = 1e-11;  // the caller checks against its own, in pixels
  glm::dvec2 error = model.distorted_before_tilt(p) - point;
  for (int step = 0; step < kMaxSteps && error != glm::dvec2{0, 0}; ++step) {
    const glm::dmat2 jacobian = model.jacobian_before_tilt(p);
    if (!(glm::determinant(jacobian) > 0)) break;
    glm::dvec2 move = -(glm::inverse(jacobian) * error);
    bool nearer = false;
    for (int halving = 0; halving < kMaxHalvings && !nearer; ++halving, move *= 0.5) {
      const glm::dvec2 candidate = p + move;
      if (!(glm::length(candidate) < field.radius)) continue;
      const glm::dvec2 candidate_error = model.distorted_before_tilt(candidate) - point;
      nearer = glm::dot(candidate_error, candidate_error) < glm::dot(error, error);
      if (nearer) p = candidate, error = candidate_error;
    }
    if (!nearer) break;
  }
  if (!(glm::length(error) <= kGoodEnough * (1 + glm::length(point)))) return std::nullopt;
  return p;
}

// True where the point lies outside the distorted rim by more than the rim's corners cut off: then nothing can meet it.
// Sum of turns: a curve goes round a point inside it once and round one outside not at all.
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

// Tries Newton's method from the best place of each of many circles, spread evenly by angle from the axis.
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

}  // namespace sigs::distortion
