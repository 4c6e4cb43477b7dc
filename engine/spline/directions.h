// SPDX-License-Identifier: MIT
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "base/pose.h"
#include "spline/constant_speed.h"
#include "spline/piecewise_cubic.h"

namespace sigs {

// Geometry of directions, and gravity. All angles are in radians, all vectors in the world (Z down). angle_between() is
// in base/pose.h.

inline constexpr glm::dvec3 kWorldUp{0, 0, -1};

// The part of v that is perpendicular to a unit direction.
[[nodiscard]] inline glm::dvec3 across(const glm::dvec3& v, const glm::dvec3& direction) {
  return v - dot(v, direction) * direction;
}

// The angle about a unit axis that rotates a into b, by the right-hand rule, -pi..pi. a and b are perpendicular to the
// axis.
[[nodiscard]] double signed_angle(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& axis);

// v rotated about a unit axis perpendicular to it, by the right-hand rule.
[[nodiscard]] glm::dvec3 turned(const glm::dvec3& v, const glm::dvec3& axis, double angle_rad);

// The point on the great circle between two unit vectors; share runs from 0 (from) to 1 (to). The two vectors must not
// be opposite.
[[nodiscard]] glm::dvec3 along_arc(const glm::dvec3& from, const glm::dvec3& to, double share);

// An up vector carried along while the nose turns the shortest way from one direction to another (parallel transport on
// the sphere). The result is a unit vector perpendicular to the new nose; `up` is perpendicular to the old one.
[[nodiscard]] glm::dvec3 transported(const glm::dvec3& up, const glm::dvec3& from_nose, const glm::dvec3& to_nose);

inline constexpr double kGravity_mps2 = 9.80665;  // standard gravity, ISO 80000-3

// Specific force, the acceleration that the wings have to provide: acceleration less gravity. Points up in level
// flight.
[[nodiscard]] inline glm::dvec3 specific_force_mps2(const Motion& motion) {
  return motion.acceleration_mps2 - glm::dvec3(0, 0, kGravity_mps2);
}

// The direction of an aircraft's nose along a curve.

// A curve at one moment. nose is the direction of the velocity, a unit vector, or zero where the curve stands still:
// where it is so slow that its velocity gives no useful direction.
struct PathSample {
  double time_s = 0;
  Motion motion;
  glm::dvec3 nose{0, 0, 0};

  [[nodiscard]] bool stands() const { return nose == glm::dvec3(0); }
};

// Samples of a curve in order of time, and the largest angle by which the nose should turn between neighbours. Where it
// turns by more, although the neighbours are as close as they get, the path has a corner: a cusp or a reversal.
struct PathSamples {
  std::vector<PathSample> all;
  double tolerance_rad = 0;

  // Whether the velocity does not give the nose between samples i and i + 1: the curve stands still or has a corner
  // there.
  [[nodiscard]] bool unclear_after(std::size_t i) const;
};

// Samples from 2 s before the first waypoint to 2 s after the last one, so close that nose and specific force turn by a
// few degrees at most from one to the next. At most about 500 for each piece of the curve.
[[nodiscard]] PathSamples sampled_path(const TimedCurve& timed_curve);

// The direction of the nose at any time: along the velocity, except where the curve stands still or has a corner. There
// the nose turns along a great circle from the last clear direction to the next one; a turn by 180 degrees goes over
// the right-hand side. A turn takes as long as the curve stands still, and at least 0.2 s for 180 degrees, in
// proportion; turns that would overlap are one. Where the curve stands still at its beginning the nose points in the
// next clear direction, at its end in the last one; where there is none at all it points along world X.
class Nose {
 public:
  Nose(const TimedCurve& timed_curve, const PathSamples& path_samples);

  // Unit vector, continuous in time. velocity_mps is the curve's at time_s, which must lie within the samples.
  [[nodiscard]] glm::dvec3 at(double time_s, const glm::dvec3& velocity_mps) const;

  // Whether a turn gives the nose at that time, not the velocity.
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

  std::vector<Turn> turns_;  // in order of time, without overlap
};

}  // namespace sigs
