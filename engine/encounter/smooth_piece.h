// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <functional>
#include <vector>

#include "encounter/encounter_track.h"

namespace sigs {

// Where functions of a relative motion change their sign. The motion is cut into pieces in which both flights are cubic
// in time, to 1e-8 m. A function that is a polynomial of position and velocity, of degree 10 in time at most, is then
// known everywhere in the piece by eleven values, and Bernstein's form of it shows all its sign changes: none is missed
// between two instants, however brief what lies between.

inline constexpr std::size_t kPieceNodes = 11;

// A stretch of time and the relative motion at eleven instants within, the ends not among them.
struct SmoothPiece {
  double begin_s = 0;
  double end_s = 0;
  std::array<RelativeState, kPieceNodes> nodes = {};
};

using RelativeMotionAt = std::function<RelativeState(double time_s)>;

// Calls `visit` with the pieces from begin_s to end_s, in order and without gaps.
//   knots_s      rising; pieces end there
//   rounding_m   how far the relative position may be off by rounding: of flights far from the origin
// A piece is not cut below 1 ms, nor below some units in the last place of the time.
void for_each_smooth_piece(const RelativeMotionAt& motion, double begin_s, double end_s,
                           const std::vector<double>& knots_s, double rounding_m,
                           const std::function<void(const SmoothPiece&)>& visit);

// The value of a function, and the size of the largest terms that it is the sum of: what is below 1e-13 of that is
// rounding.
struct TermSum {
  double value = 0;
  double size = 0;
};
using MotionFunction = std::function<TermSum(const RelativeState&)>;

// Appends the times within the piece at which a function changes its sign, to 1e-10 s or some units in the last place
// of the time. A function that is zero throughout, but for rounding, has none.
void append_sign_changes(const SmoothPiece& piece, const RelativeMotionAt& motion, const MotionFunction& function,
                         std::vector<double>& times_s);

}  // namespace sigs
