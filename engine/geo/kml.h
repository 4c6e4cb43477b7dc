// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "geo/geo_path.h"

namespace sigs {

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

}  // namespace sigs
