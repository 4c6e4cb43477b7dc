// SPDX-License-Identifier: MIT

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <glm/glm.hpp>
#include <limits>
#include <numbers>
#include <numeric>
#include <optional>
#include <span>

#include "camera/distortion_models.h"

namespace sigs::distortion {
namespace {

using Complex = std::complex<double>;

constexpr double kLargestRadius = 1e8;
constexpr double kSmallestDenominator = 1e-6;

// A quantity along a circle: mean + Re(first e^{i phi}) + Re(second e^{2 i phi}).
struct Harmonics {
  double mean = 0;
  Complex first;
  Complex second;

  [[nodiscard]] double at(Complex turn) const { return mean + (first * turn + second * turn * turn).real(); }
};

// A minimum of a function: where it is, and its value.
struct Minimum {
  double x = 0;
  double value = 0;
};

// The minimum between a and b, which enclose only one, by golden section search.
template <class Function>
Minimum minimum_between(const Function& f, double a, double b) {
  constexpr double kGolden = 1 / std::numbers::phi;
  double x1 = b - kGolden * (b - a);
  double x2 = a + kGolden * (b - a);
  double f1 = f(x1);
  double f2 = f(x2);
  constexpr int kSteps = 40;  // 0.618^40 = 4e-9 of the interval: a parabola's minimum to the last bit
  for (int step = 0; step < kSteps; ++step) {
    if (f1 < f2) {
      b = x2, x2 = x1, f2 = f1;
      x1 = b - kGolden * (b - a), f1 = f(x1);
    } else {
      a = x1, x1 = x2, f1 = f2;
      x2 = a + kGolden * (b - a), f2 = f(x2);
    }
  }
  return f1 < f2 ? Minimum{x1, f1} : Minimum{x2, f2};
}

constexpr int kSamples = 32;

std::array<Complex, kSamples> turns_of_samples() {
  std::array<Complex, kSamples> turns;
  for (int i = 0; i < kSamples; ++i) turns[i] = std::polar(1.0, i * 2 * std::numbers::pi / kSamples);
  return turns;
}

// Value of the minimum near a point of the circle, by Newton's method on the derivative.
double minimum_near(const Harmonics& h, Complex turn) {
  constexpr int kSteps = 4;  // from a 64th of a circle, each squares the error
  constexpr double kFarthest_rad = 2 * std::numbers::pi / kSamples;
  for (int step = 0; step < kSteps; ++step) {
    const Complex first = h.first * turn;
    const Complex second = h.second * turn * turn;
    const double slope = -(first + 2.0 * second).imag();
    const double curvature = -(first + 4.0 * second).real();
    if (!(curvature > 0)) break;
    turn *= std::polar(1.0, std::clamp(-slope / curvature, -kFarthest_rad, kFarthest_rad));
  }
  return h.at(turn);
}

// There are at most two minima on the circle, so that 32 samples find each of them.
double smallest(const Harmonics& h) {
  static const std::array<Complex, kSamples> turns = turns_of_samples();
  std::array<double, kSamples> sample{};
  for (int i = 0; i < kSamples; ++i) sample[i] = h.at(turns[i]);
  double result = *std::ranges::min_element(sample);
  for (int i = 0; i < kSamples; ++i) {
    const double before = sample[(i + kSamples - 1) % kSamples];
    const double after = sample[(i + 1) % kSamples];
    if (sample[i] <= before && sample[i] < after) result = std::min(result, minimum_near(h, turns[i]));
  }
  return result;
}

// With points as complex numbers, w = p2 + i p1 and s(r) the prism's shift, the circle of radius r is distorted to
//   f = g(r) e^{i phi} + 2 w r^2 + conj(w) r^2 e^{2 i phi} + s(r)
// and the determinant of the Jacobian is Im(conj(df/dr) df/dphi) / r.
double smallest_determinant(const BrownConrady& m, double r) {
  const Complex w{m.p2, m.p1};
  const Complex s_slope = 2 * r * Complex{m.s1, m.s3} + 4 * r * r * r * Complex{m.s2, m.s4};
  const ValueAndSlope g = m.radial(r);
  const double g_over_r = g.value / r;
  const Complex a = std::conj(4.0 * r * w + s_slope);
  const Complex b = 2.0 * r * w;
  const Complex c = std::conj(b);
  return smallest({.mean = g.slope * g_over_r + (b * c).real(),
                   .first = g.slope * c + a * g_over_r + std::conj(b) * g_over_r,
                   .second = a * c});
}

// Smallest third coordinate of a distorted circle on the tilted sensor, relative to that of the axis: zero where the
// ray runs parallel to the sensor.
double smallest_tilt_depth(const BrownConrady& m, double r) {
  const Complex w{m.p2, m.p1};
  const Complex shift = 2.0 * r * r * w + r * r * Complex{m.s1, m.s3} + r * r * r * r * Complex{m.s2, m.s4};
  const double tx = m.tilt[0].z / m.tilt[2].z;
  const double ty = m.tilt[1].z / m.tilt[2].z;
  const Complex across{tx, -ty};  // Re(across * f) = tx x + ty y
  return smallest({.mean = 1 + (across * shift).real(),
                   .first = across * m.radial(r).value,
                   .second = across * std::conj(w) * r * r}) -
         kSmallestDenominator;
}

// Largest r up to limit below which f, positive near 0, is positive throughout. f is sampled in steps of less than 1
// percent of r, and each minimum between samples is located.
template <class Function>
double positive_up_to(const Function& f, double limit) {
  constexpr double kSmallestRadius = 1e-8;
  constexpr int kSteps = 4096;
  const auto fall_between = [&f](double good, double bad) {
    for (;;) {
      const double middle = std::midpoint(good, bad);
      if (middle == good || middle == bad) return good;
      (f(middle) > 0 ? good : bad) = middle;
    }
  };
  const double growth = std::pow(limit / kSmallestRadius, 1.0 / kSteps);
  std::array<Minimum, 3> last{{{0, 1}, {0, 1}, {0, 1}}};
  for (int step = 0; step <= kSteps; ++step) {
    const double r = std::min(limit, kSmallestRadius * std::pow(growth, step));
    last = {last[1], last[2], Minimum{r, f(r)}};
    if (!(last[2].value > 0)) return fall_between(last[1].x, r);
    if (last[1].value > last[0].value || last[1].value > last[2].value) continue;
    const Minimum lowest = minimum_between(f, std::max(last[0].x, kSmallestRadius), r);
    if (!(lowest.value > 0)) return fall_between(last[0].x, lowest.x);
  }
  return limit;
}

double radial_limit(const BrownConrady& m) {
  const Polynomial numerator{1, m.k1, m.k2, m.k3};
  const Polynomial denominator{1, m.k4, m.k5, m.k6};
  const Polynomial twice_u{0, 2};
  const Polynomial r_numerator_slope = sum(numerator, product(twice_u, derivative(numerator)));
  const Polynomial slope =
      sum(product(r_numerator_slope, denominator), product(product(twice_u, numerator), derivative(denominator)), -1);
  const double largest = kLargestRadius * kLargestRadius;
  const double fold = first_fall(slope, largest);
  const double pole = first_fall(sum(denominator, {kSmallestDenominator}, -1), largest);
  return std::min(kLargestRadius, std::sqrt(std::min(fold, pole)));
}

std::vector<glm::dvec2> distorted_rim(const BrownConrady& m, double radius) {
  constexpr int kCorners = 360;
  std::vector<glm::dvec2> rim;
  for (int i = 0; i < kCorners; ++i) {
    const double phi = i * 2 * std::numbers::pi / kCorners;
    rim.push_back(m.distorted_before_tilt(radius * glm::dvec2{std::cos(phi), std::sin(phi)}));
  }
  return rim;
}

}  // namespace

Field valid_field(const BrownConrady& m) {
  const bool straight = m.k1 == 0 && m.k2 == 0 && m.k3 == 0 && m.k4 == 0 && m.k5 == 0 && m.k6 == 0;
  if (straight && m.radial_only && !m.tilted) return {};
  double radius = radial_limit(m);
  if (!m.radial_only) radius = positive_up_to([&m](double r) { return smallest_determinant(m, r); }, radius);
  if (m.tilted) radius = positive_up_to([&m](double r) { return smallest_tilt_depth(m, r); }, radius);
  return {.radius = radius, .edge = m.radial_only ? std::vector<glm::dvec2>{} : distorted_rim(m, radius)};
}

// At the rim of the sphere the distance from the axis stops increasing, so that directions just within may round to it.
constexpr double kRounding = 1 + 8 * std::numeric_limits<double>::epsilon();

Field valid_field(const Omnidirectional& m) {
  Field field = valid_field(static_cast<const BrownConrady&>(m));
  if (m.xi > 1) field.radius = std::min(field.radius, kRounding / std::sqrt(m.xi * m.xi - 1));
  return field;
}

Field valid_field(const DoubleSphere& m) {
  if (m.alpha <= 0.5) return {};
  return {.radius = kRounding / std::sqrt(2 * m.alpha - 1), .edge = {}};
}

Field valid_field(const ExtendedUnified& m) {
  if (m.alpha <= 0.5) return {};
  return {.radius = kRounding / std::sqrt(m.beta * (2 * m.alpha - 1)), .edge = {}};
}

Field valid_field(const KannalaBrandt& m) {
  const Polynomial slope{1, 3 * m.k[0], 5 * m.k[1], 7 * m.k[2], 9 * m.k[3]};
  const double fold = std::sqrt(first_fall(slope, std::numbers::pi * std::numbers::pi));
  return {.radius = std::min(fold, std::numbers::pi), .edge = {}};
}

// The inverse.

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
