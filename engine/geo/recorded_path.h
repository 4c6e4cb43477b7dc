// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "base/input_file.h"
#include "base/result.h"
#include "geo/geodetic.h"

#include <glm/glm.hpp>

namespace sigs {

// Paths that something flew, as files have them: GPX, KML, and what receivers of ADS-B and the OpenSky Network write
// (README.md lists the formats).

// A place and when something was there.
struct TimedPlace {
  double time_s = 0;  // RecordedPath says what it counts from
  GeodeticPosition place;

  [[nodiscard]] bool operator==(const TimedPlace&) const = default;
};

// What the heights of a path are measured from. They are never converted: that would need a model of the geoid, of the
// ground or of the weather. The geoid lies between 107 m below and 86 m above the ellipsoid.
enum class HeightReference {
  ellipsoid,  // WGS-84
  sea_level,  // the geoid, as receivers of GPS show it and KML defines it
  pressure,   // the pressure's height in the standard atmosphere (1013.25 hPa), whatever the weather: off by some 100 m
  ground,     // the ground below
  unknown,    // the file has no heights; all are 0
};

// "above the ellipsoid", ...
[[nodiscard]] std::string_view name_of(HeightReference reference);

// One path. Its places pass check_place(), the height in whatever HeightReference the file has.
struct RecordedPath {
  std::string name;  // callsign, else the ICAO address; name of the GPX track or KML placemark; may be empty. One line
  std::string icao24;  // the aircraft's address in hexadecimal digits, with ~ before one that is none of ICAO's, lower
                       // case; empty where the format has none
  std::vector<TimedPlace> points;  // at least one; times rise strictly
  bool has_times = true;           // false: time_s is the point's number, 0, 1, 2, ...
  bool utc = false;                // time_s counts from 1970-01-01 in UTC without leap seconds; false: from anything
  HeightReference height = HeightReference::unknown;
  std::vector<Warning> warnings;  // points left out, heights that are not the ellipsoid's, gaps; a line for each kind
};

// The largest file that is read.
inline constexpr std::uint64_t kRecordedPathLimit_bytes = 256 * kMebibyte;

// Reads all paths of a file, in its order. The content says which format it is, not the name.
//
// Points are put in order of time. Left out, each with a warning: places that check_place() refuses or that are exactly
// 0/0, points without a time where others have one, later points of the same time. A longitude up to 360 degrees is
// brought into range. A height that one point lacks follows from the points beside it. A line without times that passes
// the same places as a path with times is left out: it is the same path, drawn for programs that ignore times.
//
// Errors: cannot_read; bad_data with the place in the file: not one of the formats, broken, nested too deeply, without
// a single usable point.
[[nodiscard]] Result<std::vector<RecordedPath>> read_recorded_paths(const std::filesystem::path& path);

// The same from a text. `where` names it in messages.
[[nodiscard]] Result<std::vector<RecordedPath>> recorded_paths_of(std::string_view text, const std::string& where);

// The ranges that the points of a path cover. From west to east, eastwards, is the shortest range of longitudes: west
// is greater than east where the path crosses the antimeridian.
struct PathExtent {
  double south_deg = 0;
  double north_deg = 0;
  double west_deg = 0;
  double east_deg = 0;
  double low_m = 0;
  double high_m = 0;
};

// There must be at least one point.
[[nodiscard]] PathExtent extent_of(const std::vector<TimedPlace>& points);

// A point of the world and when something is there.
struct WorldWaypoint {
  double time_s = 0;  // as RecordedPath::points
  glm::dvec3 position_m{0, 0, 0};
};

// The path in the world, with as many of its points as it takes: between neighbours that are left out, straight flight
// at even speed passes every point of the path, at that point's time, within tolerance_m. Of a path without times,
// which has no speed, the straight line passes every point within tolerance_m. First and last point always stay.
// Douglas and Peucker's method (Cartographica 10(2), 1973), in space and time.
//
// So a noisy path needs a tolerance above its noise: some metres for ADS-B. Heights are taken as the path has them.
//   tolerance_m  0 or more, finite; 0 keeps all points
[[nodiscard]] std::vector<WorldWaypoint> waypoints_of(const RecordedPath& path, const LocalFrame& frame,
                                                      double tolerance_m);

}  // namespace sigs
