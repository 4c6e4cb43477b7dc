// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "geo/recorded_path.h"

namespace sigs::test {

// A small file of each format, made by hand from the format's description.

extern const std::string kGpxExample;         // two tracks and a route
extern const std::string kKmlExample;         // gx:Track, gx:MultiTrack, LineString, points with times
extern const std::string kAircraftExample;    // aircraft.json of readsb
extern const std::string kTraceExample;       // a trace of readsb
extern const std::string kStatesExample;      // states/all of the OpenSky Network
extern const std::string kTrackExample;       // tracks of the OpenSky Network
extern const std::string kOpenskyCsvExample;  // state vectors of the OpenSky Network

// A GPX file with one track of these trkpt elements.
[[nodiscard]] std::string gpx_of(const std::string& points);

// Whether a warning of the path contains a text.
[[nodiscard]] bool has_warning(const RecordedPath& path, const std::string& part);

}  // namespace sigs::test
