// SPDX-License-Identifier: MIT
#pragma once

#include <glm/glm.hpp>
#include <variant>
#include <vector>

#include "spline/piecewise_cubic.h"

namespace sigs {

// The timing of a curve: as its own parameter says (PiecewiseCubic) or at one speed (ConstantSpeed); a TimedCurve is
// either of the two.

// Arc length along a curve, and back from the arc length to the curve's own parameter (its time in seconds). The length
// is found by Gauss-Legendre quadrature on arcs that are halved until they agree to 1e-13 of the total length, the
// parameter by Newton's method kept inside a bracket. Both are accurate to about 1e-12 of the total length.
class ArcLength {
 public:
  explicit ArcLength(PiecewiseCubic curve);

  [[nodiscard]] const PiecewiseCubic& curve() const { return curve_; }

  // Length from the first knot to the last; 0 where the curve stays at one point.
  [[nodiscard]] double total_m() const { return total_m_; }

  // Length from the first knot to parameter_s, which is clamped to the curve's knots.
  [[nodiscard]] double arc_length_m_at(double parameter_s) const;

  // The inverse; arc_length_m is clamped to 0..total_m(). Where the curve stands still for some time, the end of that
  // time.
  [[nodiscard]] double parameter_s_at(double arc_length_m) const;

 private:
  // An interval of the curve on which the quadrature is accurate. Intervals without length are left out.
  struct Arc {
    double from_s;
    double to_s;
    double arc_length_before_m;
  };

  [[nodiscard]] double quadrature_m(double from_s, double to_s) const;
  void append_arcs(double from_s, double to_s, double accuracy_m, int halvings_left);
  void append_arc(double from_s, double to_s, double length_m);

  PiecewiseCubic curve_;
  std::vector<Arc> arcs_;
  double total_m_ = 0;
};

// The same curve at one speed, from its first knot's time to its last one's. Velocity is the speed times the unit
// tangent; acceleration is the curvature times the speed squared, normal to the path. A curve without length hovers. At
// a cusp, where the tangent reverses at once, the velocity is the one after the cusp and the acceleration 0.
class ConstantSpeed {
 public:
  explicit ConstantSpeed(PiecewiseCubic curve);

  [[nodiscard]] Motion motion_at(double time_s) const;

  [[nodiscard]] const std::vector<double>& knots_s() const { return arc_length_.curve().knots_s(); }
  [[nodiscard]] double first_s() const { return arc_length_.curve().first_s(); }
  [[nodiscard]] double last_s() const { return arc_length_.curve().last_s(); }

  // The points of the curve that PiecewiseCubic::sample_times_s() chooses, at the times at which they are passed here.
  [[nodiscard]] std::vector<double> sample_times_s(int per_piece) const;

 private:
  [[nodiscard]] glm::dvec3 tangent_beside(double parameter_s) const;

  ArcLength arc_length_;
  double speed_mps_ = 0;
};

// A curve together with its timing.
using TimedCurve = std::variant<PiecewiseCubic, ConstantSpeed>;

[[nodiscard]] inline Motion motion_at(const TimedCurve& timed_curve, double time_s) {
  return std::visit([time_s](const auto& timed) { return timed.motion_at(time_s); }, timed_curve);
}

[[nodiscard]] inline std::vector<double> sample_times_s(const TimedCurve& timed_curve, int per_piece) {
  return std::visit([per_piece](const auto& timed) { return timed.sample_times_s(per_piece); }, timed_curve);
}

// Number of cubic pieces, one less than knots.
[[nodiscard]] inline std::size_t piece_count(const TimedCurve& timed_curve) {
  return std::visit([](const auto& timed) { return timed.knots_s().size() - 1; }, timed_curve);
}

}  // namespace sigs
