// SPDX-License-Identifier: MIT
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

#include "ego_motion/settings.h"
#include "telemetry/track.h"

namespace sigs {

// The integral of recorded rates over time, each axis for itself: exact between samples for rates that change linearly.
// That is a rotation vector only over intervals in which the turn is small.
class RateIntegral {
 public:
  // Rates that are not finite and times that fall back are left out.
  explicit RateIntegral(const Channel<glm::dvec3>& rates);

  [[nodiscard]] bool empty() const { return times_s_.size() < 2; }
  [[nodiscard]] double first_s() const { return times_s_.front(); }
  [[nodiscard]] double last_s() const { return times_s_.back(); }

  // From one time to another. Beyond the record's ends rates are 0; covers() tells.
  [[nodiscard]] glm::dvec3 between(double from_s, double to_s) const;
  [[nodiscard]] bool covers(double from_s, double to_s) const;

 private:
  [[nodiscard]] glm::dvec3 up_to(double time_s) const;
  std::vector<double> times_s_;
  std::vector<glm::dvec3> rates_;
  std::vector<glm::dvec3> sums_;
};

// How the camera turned between two frames, seen in the images.
struct SeenTurn {
  double from_s = 0;
  double to_s = 0;
  glm::dvec3 turn_rad;  // about the camera's axes
};

// Time of the log that belongs to a time of the footage: t + offset_s + drift * (t - middle_s).
struct TimeOffset {
  double offset_s = 0;  // at the middle of the footage
  double offset_sd_s = 0;
  double drift = 0;  // seconds a second; 0 where it is smaller than three times its standard deviation
  double drift_sd = 0;
  double middle_s = 0;
  double correlation = 0;  // of the turns seen and recorded, all axes together
  double slope = 0;        // of the turns seen by those recorded, by least squares

  [[nodiscard]] double log_time_s(double footage_s) const {
    return footage_s + offset_s + drift * (footage_s - middle_s);
  }
};

// The offset with which turns seen and recorded have the highest correlation, between -max_offset_s and max_offset_s in
// steps of 5 ms; a parabola through the highest values gives it to parts of a step. Coarse to fine: offsets half a
// frame apart are compared by some of the turns, then those of 5 ms about the good ones, and the best of these by all
// turns. Where log and footage belong together, that finds the maximum of all steps. Drift: a line through the offsets
// of four parts of the footage. Nothing where fewer than 20 turns can be compared, or where the search was cancelled.
[[nodiscard]] std::optional<TimeOffset> time_offset(std::span<const SeenTurn> turns, const RateIntegral& rates,
                                                    double max_offset_s, const StepControl& control = {});

}  // namespace sigs
