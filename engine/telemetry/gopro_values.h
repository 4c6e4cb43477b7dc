// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>

namespace sigs {

// Small things that the reading of GoPro's telemetry (gopro.h) needs for its values and warnings.

inline constexpr double kSecondsPerDay = 86400;

// UTC of GPSU's "yymmddhhmmss.sss", seconds since 1970 without leap seconds; nothing where it is no date.
[[nodiscard]] std::optional<double> utc_of_gpsu(const std::string& text);

// "at 1.20 s", "from 1.20 to 3.40 s"
[[nodiscard]] std::string span_text(double first_s, double last_s);

// Samples of a stream that are left out for one reason: how many, and when.
struct LeftOutSpan {
  int count = 0;
  double first_s = 0;
  double last_s = 0;

  void add(double time_s) {
    if (count++ == 0) first_s = time_s;
    last_s = time_s;
  }
};

}  // namespace sigs
