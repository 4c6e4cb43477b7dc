// SPDX-License-Identifier: MIT
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "spline/path_samples.h"

namespace sigs {

// Where the nose points at any time: along the velocity, save where the curve stands or has a corner. Those moments
// lie in a Turn: there the nose goes along a great circle from the last good direction to the next one, a full
// about-turn by way of the right-hand side. A turn takes as long as the curve stands, and no less than 0.2 s for 180
// degrees, in proportion; turns that would overlap are one. Standing at the beginning or the end the nose waits in the
// next or rests in the last direction; where there is none at all it points along world X.
class Nose {
 public:
  Nose(const TimedCurve& timed_curve, const PathSamples& path_samples);

  // Unit. Continuous in time; velocity_mps is that of the curve at time_s, which must lie within the samples.
  [[nodiscard]] glm::dvec3 at(double time_s, const glm::dvec3& velocity_mps) const;

  // Whether the nose is led by a turn at that time, not by the velocity.
  [[nodiscard]] bool turning_at(double time_s) const { return turn_at(time_s) != nullptr; }

  // Ascending times from the first sample to the last, so close that the nose turns little from one to the next.
  [[nodiscard]] std::vector<double> sample_times_s(const PathSamples& path_samples) const;

 private:
  struct Turn {
    double from_s;
    double to_s;
    glm::dvec3 from_nose;
    glm::dvec3 by_nose;  // half-way
    glm::dvec3 to_nose;

    [[nodiscard]] glm::dvec3 nose_at(double time_s) const;
  };

  struct Span {
    double from_s;
    double to_s;
  };

  [[nodiscard]] static std::vector<Span> unclear_spans(const PathSamples& path_samples);
  [[nodiscard]] static Turn turn_over(const Span& span, const TimedCurve& timed_curve, const PathSamples& path_samples);
  [[nodiscard]] const Turn* turn_at(double time_s) const;

  std::vector<Turn> turns_;  // in order of time, none over another
};

}  // namespace sigs
