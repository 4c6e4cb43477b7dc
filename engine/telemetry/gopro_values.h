// SPDX-License-Identifier: MIT
#pragma once

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <optional>
#include <string>

#include "geo/geodetic.h"

namespace sigs {

// Small things that the reading of GoPro's telemetry (gopro.h) needs for its values and warnings.

inline constexpr double kSecondsPerDay = 86400;

// Whether a value can be a sample: finite, and a place also on the Earth.
[[nodiscard]] bool is_finite(double value);
[[nodiscard]] bool is_finite(const glm::dvec3& v);
[[nodiscard]] bool is_finite(const glm::dquat& q);
[[nodiscard]] bool is_finite(const GeodeticPosition& p);

// UTC of GPSU's "yymmddhhmmss.sss", seconds since 1970 without leap seconds; nothing where it is no date.
[[nodiscard]] std::optional<double> utc_of_gpsu(const std::string& text);

// "at 1.20 s", "from 1.20 to 3.40 s"
[[nodiscard]] std::string span_text(double first_s, double last_s);

// Samples that are left out: how many, and when.
struct LeftOut {
  int count = 0;
  double first_s = 0;
  double last_s = 0;

  void add(double time_s) {
    if (count++ == 0) first_s = time_s;
    last_s = time_s;
  }
};

}  // namespace sigs
