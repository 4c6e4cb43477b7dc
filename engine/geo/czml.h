// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "geo/geo_path.h"

namespace sigs {

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
