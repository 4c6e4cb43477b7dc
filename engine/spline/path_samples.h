// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "spline/timed_curve.h"

namespace sigs {

// A look at a curve at one moment. The nose is the direction of the velocity, or zero where the curve stands: where
// it is so slow that its velocity tells no direction that anyone would want to see.
struct PathSample {
  double time_s = 0;
  Motion motion;
  glm::dvec3 nose{0, 0, 0};

  [[nodiscard]] bool stands() const { return nose == glm::dvec3(0); }
};

// PathSamples of a curve, in order of time, and how far the nose turns at most between neighbours. Where it turns by
// more although the neighbours are as close as they get, the path has a corner: a cusp, or a reversal.
struct PathSamples {
  std::vector<PathSample> all;
  double tolerance_rad = 0;

  // The nose between samples i and i + 1 cannot be had from the velocity: the curve stands there, or has a corner.
  [[nodiscard]] bool unclear_after(std::size_t i) const;
};

// From a little before the first waypoint to a little after the last one, closely enough for nose and specific force to
// turn by a few degrees at most from sample to sample; at most some 500 for each piece of the curve.
[[nodiscard]] PathSamples sampled_path(const TimedCurve& timed_curve);

}  // namespace sigs
