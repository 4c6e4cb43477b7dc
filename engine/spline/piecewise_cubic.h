// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <vector>

#include "spline/motion.h"

namespace sigs {

// One piece of a curve: X(s) = c[0] + c[1] s + c[2] s^2 + c[3] s^3 in metres, s in seconds since the piece began.
using CubicPiece = std::array<glm::dvec3, 4>;

// A curve in the world made of cubic pieces, each on its own stretch of time; both kinds of spline are one. Every piece
// counts time and way from its own beginning, so that nothing is lost far from the origin. Before the first and after
// the last knot it goes straight on.
class PiecewiseCubic {
 public:
  // knots_s: strictly increasing, one more than pieces. end_m: the point at the last knot. Without pieces: stays there.
  PiecewiseCubic(std::vector<double> knots_s, std::vector<CubicPiece> pieces, const glm::dvec3& end_m);

  // O(log n). Acceleration at a knot is that of the piece that begins there; beyond the ends it is zero.
  [[nodiscard]] Motion motion_at(double time_s) const;

  [[nodiscard]] const std::vector<double>& knots_s() const { return knots_s_; }
  [[nodiscard]] double first_s() const { return knots_s_.front(); }
  [[nodiscard]] double last_s() const { return knots_s_.back(); }

  // Ascending times that cut every piece into per_piece equal parts and, between those, wherever the speed is least or
  // greatest: from one time to the next the speed only rises or only falls, so no moment of standing still is missed.
  [[nodiscard]] std::vector<double> sample_times_s(int per_piece) const;

 private:
  std::vector<double> knots_s_;
  std::vector<CubicPiece> pieces_;
  glm::dvec3 end_m_;
};

}  // namespace sigs
