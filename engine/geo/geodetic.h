// SPDX-License-Identifier: MIT
#pragma once

#include <glm/glm.hpp>
#include <memory>

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

// Where the world lies on the Earth: its plane z = 0 touches the WGS-84 ellipsoid, raised to the origin's height, at
// the origin, and its X axis has a heading there. The world is flat: z is the depth below that plane, so height above
// the ellipsoid and -z part with the square of the distance, 0.08 m at 1 km, 7.8 to 7.9 m at 10 km.
class LocalFrame {
 public:
  //   origin       finite, within the ranges of GeodeticPosition; of the world's point (0, 0, 0)
  //   heading_rad  of world X at the origin, from true north to the right
  LocalFrame(const GeodeticPosition& origin, double heading_rad);

  // Point of the world (X along the heading, Y right, Z down; metres) of a place, and back. Exact to some nanometres.
  [[nodiscard]] glm::dvec3 world_of(const GeodeticPosition& place) const;
  [[nodiscard]] GeodeticPosition place_of(const glm::dvec3& p_in_world) const;

  // A vector of the tangent plane at the origin, north, east, down, in the world's axes, and back.
  [[nodiscard]] glm::dvec3 world_of_ned(const glm::dvec3& ned) const;
  [[nodiscard]] glm::dvec3 ned_of_world(const glm::dvec3& in_world) const;

  [[nodiscard]] const GeodeticPosition& origin() const { return origin_; }
  [[nodiscard]] double heading_rad() const { return heading_rad_; }

 private:
  struct Cartesian;
  GeodeticPosition origin_;
  double heading_rad_ = 0;
  std::shared_ptr<const Cartesian> cartesian_;  // immutable
};

}  // namespace sigs
