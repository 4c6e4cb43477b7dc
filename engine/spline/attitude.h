// SPDX-License-Identifier: MIT
#pragma once

#include <glm/gtc/quaternion.hpp>
#include <vector>

#include "spline/nose.h"
#include "spline/timed_curve.h"
#include "spline/trajectory.h"

namespace sigs {

// How an aircraft lies in the air along a curve: the nose of nose.h, the up of up_target.h, the roll of roll.h.
// Worked out once for the whole flight; a look-up depends on the time alone, and is continuous in it everywhere.
//
// Roll is counted from an up vector that is carried along with the nose and never rolls by itself (parallel transport),
// because an up made from the vertical breaks down where the nose points straight up, and one made from the force where
// there is none. Between the table's entries that vector is carried on to the very direction of the velocity, so the
// table's spacing does not show in the nose.
class AttitudeTable {
 public:
  AttitudeTable(const TimedCurve& timed_curve, Bank bank, double bank_limit_rad);

  // Unit quaternion from body to world. velocity_mps: the curve's, at that time.
  [[nodiscard]] glm::dquat world_from_body(double time_s, const glm::dvec3& velocity_mps) const;

 private:
  struct Entry {
    double time_s;
    glm::dvec3 nose;
    glm::dvec3 transported_up;  // unit, across the nose
    double roll_rad;            // from transported_up, right wing down
  };

  AttitudeTable(const TimedCurve& timed_curve, const PathSamples& path_samples, Bank bank, double bank_limit_rad);
  [[nodiscard]] double roll_rad_at(std::size_t before, double time_s) const;
  [[nodiscard]] double roll_rate_at_entry(std::size_t i) const;
  [[nodiscard]] double roll_rate_between(std::size_t i) const;

  Nose nose_;
  std::vector<Entry> entries_;  // at least two
};

}  // namespace sigs
