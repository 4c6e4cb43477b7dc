// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "spline/arc_length.h"
#include "spline/motion.h"

namespace sigs {

// The same curve timed at one speed, from its first knot's time to its last one's. Velocity is speed times the unit
// tangent; acceleration is curvature times speed squared, across the path. A curve without length hovers. At a cusp,
// where the tangent turns about at once, velocity is the one after it and acceleration 0.
class ConstantSpeed {
 public:
  explicit ConstantSpeed(PiecewiseCubic curve);

  [[nodiscard]] Motion motion_at(double time_s) const;

  // As for PiecewiseCubic: the same points of the curve, at the times at which they are passed here.
  [[nodiscard]] const std::vector<double>& knots_s() const { return arc_length_.curve().knots_s(); }
  [[nodiscard]] double first_s() const { return arc_length_.curve().first_s(); }
  [[nodiscard]] double last_s() const { return arc_length_.curve().last_s(); }
  [[nodiscard]] std::vector<double> sample_times_s(int per_piece) const;

 private:
  [[nodiscard]] glm::dvec3 tangent_beside(double parameter_s) const;

  ArcLength arc_length_;
  double speed_mps_ = 0;
};

}  // namespace sigs
