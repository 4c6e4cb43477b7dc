// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "spline/piecewise_cubic.h"

namespace sigs {

// The way along a curve, and back from way to the curve's own parameter (the time at which the curve would be there).
// Gauss-Legendre quadrature on arcs halved until they agree to 1e-13 of the whole way; the way back by Newton's method
// kept inside its bracket. Both are good to about 1e-12 of the whole way.
class ArcLength {
 public:
  explicit ArcLength(PiecewiseCubic curve);

  [[nodiscard]] const PiecewiseCubic& curve() const { return curve_; }

  // Whole way from the first knot to the last; 0 where the curve stays at one point.
  [[nodiscard]] double total_m() const { return total_m_; }

  // parameter_s is clamped to the curve's knots.
  [[nodiscard]] double arc_length_m_at(double parameter_s) const;

  // arc_length_m is clamped to 0..total_m(). Where the curve stands still for a while, the end of that while.
  [[nodiscard]] double parameter_s_at(double arc_length_m) const;

 private:
  // A stretch of the curve on which the quadrature is good; stretches without length are left out.
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

}  // namespace sigs
