// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <iterator>
#include <vector>

#include "base/ensure.h"

namespace sigs {

// Values between samples that are in the order of their times.

// Two neighbouring samples, and how far from the one to the other a time lies.
struct Neighbours {
  std::size_t before = 0;
  std::size_t after = 0;  // the same as `before` at a sample, before the first and after the last one
  double share = 0;       // 0 at `before`, 1 at `after`
};

// The neighbours of a time. Of several samples at the same time the last one counts. There must be a sample.
//   time_of  a sample -> its time; rising, not strictly
template <class Samples, class TimeOf = std::identity>
[[nodiscard]] Neighbours neighbours_of(const Samples& samples, double time_s, const TimeOf& time_of = {}) {
  ENSURE(!std::empty(samples));
  const auto later = [&](double time, const auto& sample) { return time < std::invoke(time_of, sample); };
  const auto after = std::upper_bound(std::begin(samples), std::end(samples), time_s, later);
  if (after == std::begin(samples)) return {};
  const auto before = std::prev(after);
  const auto place = static_cast<std::size_t>(before - std::begin(samples));
  const double before_s = std::invoke(time_of, *before);
  if (after == std::end(samples) || before_s == time_s) return {place, place, 0};
  return {place, place + 1, (time_s - before_s) / (std::invoke(time_of, *after) - before_s)};
}

// From a (share 0) to b (share 1): numbers and vectors along a straight line, rotations by the shorter turn at constant
// rate (slerp).
[[nodiscard]] inline double interpolated(double a, double b, double share) {
  return glm::mix(a, b, share);
}
[[nodiscard]] inline glm::dvec3 interpolated(const glm::dvec3& a, const glm::dvec3& b, double share) {
  return glm::mix(a, b, share);
}
[[nodiscard]] inline glm::dquat interpolated(const glm::dquat& a, const glm::dquat& b, double share) {
  return glm::slerp(a, b, share);
}

// The value at a time: that of a sample exactly where there is one, else between its neighbours; before the first and
// after the last one as these.
//   times_s  rising, not strictly; one for each value, and at least one
template <class Value>
[[nodiscard]] Value value_at(const std::vector<double>& times_s, const std::vector<Value>& values, double time_s) {
  ENSURE(times_s.size() == values.size());
  const Neighbours at = neighbours_of(times_s, time_s);
  return at.before == at.after ? values[at.before] : interpolated(values[at.before], values[at.after], at.share);
}

}  // namespace sigs
