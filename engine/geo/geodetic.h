// SPDX-License-Identifier: MIT
#pragma once

namespace sigs {

// A place on the Earth, WGS-84. Degrees, unlike every other angle inside the program: all files and GeographicLib have
// them, and a path that is read and written again must not lose digits to a conversion.
struct GeodeticPosition {
  double latitude_deg = 0;   // -90..90, north positive
  double longitude_deg = 0;  // -180..180, east positive
  double height_m = 0;       // above the ellipsoid, unless whoever has it says otherwise

  [[nodiscard]] bool operator==(const GeodeticPosition&) const = default;
};

}  // namespace sigs
