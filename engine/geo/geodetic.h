// SPDX-License-Identifier: MIT
#pragma once

#include "base/result.h"

namespace sigs {

// A place on the Earth, WGS-84. Degrees, unlike every other angle inside the program: all files and GeographicLib have
// them, and a path that is read and written again must not lose digits to a conversion.
struct GeodeticPosition {
  double latitude_deg = 0;   // -90..90, north positive
  double longitude_deg = 0;  // -180..180, east positive
  double height_m = 0;       // above the ellipsoid, unless whoever has it says otherwise

  [[nodiscard]] bool operator==(const GeodeticPosition&) const = default;
};

// The range of heights that check_place() accepts: below the deepest trench, and above every orbit near the Earth.
inline constexpr double kLowestHeight_m = -12e3;
inline constexpr double kHighestHeight_m = 1e7;

// Checks that all three numbers are finite and within their ranges. Whatever comes from outside is checked so before it
// becomes a point of the world: GeographicLib answers latitudes beyond 90 degrees and NaN with NaN, without an error.
// Error bad_data that says which number is wrong; `where` of the error is empty.
[[nodiscard]] Result<void> check_place(const GeodeticPosition& place);

}  // namespace sigs
