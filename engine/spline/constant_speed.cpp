// SPDX-License-Identifier: MIT
#include "spline/constant_speed.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace sigs {

namespace {

constexpr double kAccuracy = 1e-13;  // of the total length
constexpr int kMaxHalvings = 30;     // at a cusp the integrand has a kink: the error falls by four with each halving
constexpr int kMaxNewtonSteps = 60;

// Abramowitz and Stegun, table 25.4, n = 8; the other four nodes are the mirror image.
struct Node {
  double x;
  double weight;
};
constexpr std::array<Node, 4> kGaussLegendre{{{0.1834346424956498, 0.3626837833783620},
                                              {0.5255324099163290, 0.3137066458778873},
                                              {0.7966664774136267, 0.2223810344533745},
                                              {0.9602898564975363, 0.1012285362903763}}};

// Share of the mean speed below which rounding decides the direction of the curve's velocity.
constexpr double kStanding = 1e-9;
// Distance from such a point at which its tangent is sought first, as a share of the whole duration.
constexpr double kFirstShare = 1e-7;

}  // namespace

ArcLength::ArcLength(PiecewiseCubic curve) : curve_(std::move(curve)) {
  const std::vector<double>& knots_s = curve_.knots_s();
  double rough_m = 0;
  for (std::size_t i = 0; i + 1 < knots_s.size(); ++i) rough_m += quadrature_m(knots_s[i], knots_s[i + 1]);
  for (std::size_t i = 0; i + 1 < knots_s.size(); ++i)
    append_arcs(knots_s[i], knots_s[i + 1], kAccuracy * rough_m, kMaxHalvings);
}

double ArcLength::quadrature_m(double from_s, double to_s) const {
  const double half_s = (to_s - from_s) / 2;
  const double middle_s = from_s + half_s;
  double sum_mps = 0;
  for (const auto& [x, weight] : kGaussLegendre)
    sum_mps += weight * (length(curve_.motion_at(middle_s - x * half_s).velocity_mps) +
                         length(curve_.motion_at(middle_s + x * half_s).velocity_mps));
  return sum_mps * half_s;
}

void ArcLength::append_arcs(double from_s, double to_s, double accuracy_m, int halvings_left) {
  const double middle_s = from_s + (to_s - from_s) / 2;
  const double first_half_m = quadrature_m(from_s, middle_s);
  const double second_half_m = quadrature_m(middle_s, to_s);
  const double error_m = std::abs(quadrature_m(from_s, to_s) - (first_half_m + second_half_m));
  if (error_m > accuracy_m && halvings_left > 0) {
    append_arcs(from_s, middle_s, accuracy_m, halvings_left - 1);
    append_arcs(middle_s, to_s, accuracy_m, halvings_left - 1);
    return;
  }
  append_arc(from_s, middle_s, first_half_m);
  append_arc(middle_s, to_s, second_half_m);
}

void ArcLength::append_arc(double from_s, double to_s, double length_m) {
  if (length_m <= 0) return;
  arcs_.push_back({from_s, to_s, total_m_});
  total_m_ += length_m;
}

double ArcLength::arc_length_m_at(double parameter_s) const {
  const auto next = std::upper_bound(arcs_.begin(), arcs_.end(), parameter_s,
                                     [](double value, const Arc& arc) { return value < arc.from_s; });
  if (next == arcs_.begin()) return 0;
  const Arc& arc = *std::prev(next);
  if (parameter_s >= arc.to_s) return next == arcs_.end() ? total_m_ : next->arc_length_before_m;
  return arc.arc_length_before_m + quadrature_m(arc.from_s, parameter_s);
}

double ArcLength::parameter_s_at(double arc_length_m) const {
  if (arcs_.empty()) return curve_.first_s();
  if (arc_length_m >= total_m_) return arcs_.back().to_s;
  const auto next = std::upper_bound(arcs_.begin(), arcs_.end(), arc_length_m,
                                     [](double value, const Arc& arc) { return value < arc.arc_length_before_m; });
  const Arc& arc = next == arcs_.begin() ? arcs_.front() : *std::prev(next);
  const double wanted_m = std::max(arc_length_m - arc.arc_length_before_m, 0.0);
  const double length_m = (next == arcs_.end() ? total_m_ : next->arc_length_before_m) - arc.arc_length_before_m;

  double low_s = arc.from_s;
  double high_s = arc.to_s;
  double guess_s = low_s + (high_s - low_s) * std::min(wanted_m / length_m, 1.0);
  for (int step = 0; step < kMaxNewtonSteps && low_s < high_s; ++step) {
    const double excess_m = quadrature_m(arc.from_s, guess_s) - wanted_m;
    (excess_m < 0 ? low_s : high_s) = guess_s;
    const double speed_mps = length(curve_.motion_at(guess_s).velocity_mps);
    double better_s = guess_s - excess_m / speed_mps;
    if (!(better_s >= low_s && better_s <= high_s)) better_s = low_s + (high_s - low_s) / 2;  // also where speed is 0
    if (better_s == guess_s) break;
    guess_s = better_s;
  }
  return guess_s;
}

ConstantSpeed::ConstantSpeed(PiecewiseCubic curve) : arc_length_(std::move(curve)) {
  if (arc_length_.total_m() > 0) speed_mps_ = arc_length_.total_m() / (last_s() - first_s());
}

// The tangent where the curve itself stands still: the direction in which it goes on, else the one from which it came.
// It is sought close by first, and farther away only where higher derivatives vanish too, so that the direction changes
// more slowly.
glm::dvec3 ConstantSpeed::tangent_beside(double parameter_s) const {
  for (double share = kFirstShare; share < 1; share *= 10) {
    const double step_s = share * (last_s() - first_s());
    for (const double beside_s : {parameter_s + step_s, parameter_s - step_s}) {
      const glm::dvec3 velocity_mps = arc_length_.curve().motion_at(beside_s).velocity_mps;
      const double curve_mps = length(velocity_mps);
      if (curve_mps > kStanding * speed_mps_) return velocity_mps / curve_mps;
    }
  }
  return {0, 0, 0};
}

Motion ConstantSpeed::motion_at(double time_s) const {
  if (speed_mps_ == 0) return {.position_m = arc_length_.curve().motion_at(last_s()).position_m};
  const double inside_s = std::clamp(time_s, first_s(), last_s());
  const double arc_length_m = inside_s == last_s() ? arc_length_.total_m() : speed_mps_ * (inside_s - first_s());
  const double parameter_s = arc_length_.parameter_s_at(arc_length_m);
  const Motion on_curve = arc_length_.curve().motion_at(parameter_s);
  const double curve_mps = length(on_curve.velocity_mps);
  const bool standing = curve_mps <= kStanding * speed_mps_;

  const glm::dvec3 tangent = standing ? tangent_beside(parameter_s) : on_curve.velocity_mps / curve_mps;
  Motion motion{on_curve.position_m + (time_s - inside_s) * speed_mps_ * tangent, speed_mps_ * tangent, {0, 0, 0}};
  if (standing || inside_s != time_s) return motion;
  const glm::dvec3 across_mps2 = on_curve.acceleration_mps2 - dot(on_curve.acceleration_mps2, tangent) * tangent;
  const double pace = speed_mps_ / curve_mps;
  motion.acceleration_mps2 = pace * pace * across_mps2;
  return motion;
}

std::vector<double> ConstantSpeed::sample_times_s(int per_piece) const {
  std::vector<double> times_s = arc_length_.curve().sample_times_s(per_piece);
  if (speed_mps_ == 0) return times_s;
  for (double& time_s : times_s)
    time_s = std::min(first_s() + arc_length_.arc_length_m_at(time_s) / speed_mps_, last_s());
  return times_s;
}

}  // namespace sigs
