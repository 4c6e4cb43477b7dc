// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/pose.h"
#include "geo/recorded_path.h"

namespace sigs {

// A path to be written as KML or CZML, which show it on a globe.
struct GeoPath {
  std::string name = {};         // any bytes; what is not UTF-8 becomes U+FFFD
  std::string description = {};  // for the reader: where it comes from, what its heights are; may be empty
  std::array<std::uint8_t, 3> color_rgb = {255, 255, 0};
  std::vector<TimedPlace> points = {};  // as those of RecordedPath; both formats are written with the heights as they
                                        // are: KML counts them from the sea, CZML from the ellipsoid
  std::vector<std::optional<Attitude>> attitudes = {};  // of the body against north, east and down at its place; one
                                                        // for each point, or empty
  bool has_times = true;                                // false: a line without times is written
  bool utc = true;  // false: time_s counts from kNoUtcEpoch_s instead of 1970, and the description says so
};

// The instant that stands for time 0 of paths whose times do not count from a known one: 2000-01-01T00:00:00Z.
inline constexpr double kNoUtcEpoch_s = 946684800.0;
inline constexpr std::string_view kNoUtcText =
    "Date and time of day are not known: 2000-01-01T00:00:00Z stands for time 0.";

// The instant of one of its points in UTC.
[[nodiscard]] inline double utc_of(const GeoPath& path, double time_s) {
  return path.utc ? time_s : kNoUtcEpoch_s + time_s;
}

// The description, and kNoUtcText where it applies.
[[nodiscard]] std::string description_of(const GeoPath& path);

// Paths as KML 2.2 (OGC 07-147r2) for Google Earth, with its extension gx:Track: time, place and attitude of each
// point. Beside each track stands the same path as a line, hidden at first, for programs without the extension; the
// line alone where the path has no times. altitudeMode is absolute, which Google Earth counts from the sea.
//
// Degrees have 9 decimals, metres 4, seconds 6: a path that is read back (geo/recorded_path.h) is the same within 1 mm.
// gx:angles has heading, tilt and roll, each clockwise about its axis as the reference of KML says: tilt and roll are
// the negative of our pitch and roll.
//   title  of the document; any bytes
// Paths without points are left out.
[[nodiscard]] std::string kml_text(const std::vector<GeoPath>& paths, const std::string& title);

// Paths as CZML, the JSON that Cesium shows (https://github.com/AnalyticalGraphicsInc/czml-writer/wiki/CZML-Guide): a
// document with a clock over the time of all paths, then a packet for each path with its position over time, its
// attitude where known, its line, a point and a label. A path without times is a line alone.
//
// Degrees have 9 decimals, metres 4, seconds 6. Attitudes are unit quaternions [x, y, z, w] that take the axes of
// Cesium's models (x forward, y left, z up) to those fixed to the Earth (WGS-84, x through 0/0, z through the north
// pole). Heights are written as they are, and Cesium counts them from the ellipsoid.
//   title  of the document; any bytes
// Paths without points are left out.
[[nodiscard]] std::string czml_text(const std::vector<GeoPath>& paths, const std::string& title);

}  // namespace sigs
