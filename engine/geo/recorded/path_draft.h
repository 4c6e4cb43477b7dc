// SPDX-License-Identifier: MIT
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "geo/recorded_path.h"

namespace sigs {

// What a file says about a path before anything is checked. The readers of all formats make drafts; repair_paths()
// makes paths of them.

struct DraftPoint {
  std::optional<double> time_s;                                    // nullopt: the file has none, or not a readable one
  double latitude_deg = std::numeric_limits<double>::quiet_NaN();  // NaN: likewise
  double longitude_deg = std::numeric_limits<double>::quiet_NaN();
  std::optional<double> height_m = {};           // from what PathDraft::height says
  std::optional<double> pressure_height_m = {};  // in the standard atmosphere
};

struct PathDraft {
  std::string name;
  std::string icao24;
  HeightReference height = HeightReference::unknown;  // of DraftPoint::height_m
  bool utc = true;                                    // times count from 1970
  std::vector<DraftPoint> points;
  std::vector<std::string> notes;  // warnings of the reader
};

// The paths of all drafts in which at least one point is usable, as read_recorded_paths() promises them, in their
// order. A draft that never had a point is ignored; of one without a usable point the first path warns.
// Error bad_data: there is no usable point at all.
[[nodiscard]] Result<std::vector<RecordedPath>> repair_paths(std::vector<PathDraft> drafts, const std::string& where);

// The whole text, but for white space around it, as a number with a point as decimal separator; NaN and infinity are
// numbers. nullopt: it is not one.
[[nodiscard]] std::optional<double> file_number_of(std::string_view text);

// The same with NaN for what is no number.
[[nodiscard]] double file_number_or_nan(std::string_view text);

// A name from a file on one line of UTF-8 without blanks at its ends, of at most 200 bytes or so.
[[nodiscard]] std::string file_name_text(std::string_view text);

// One reader for each kind of text. Each returns what the text says, unchecked; repair_paths() checks it.
//   text   without byte order mark
//   where  the file, for messages
// Errors bad_data: the text is broken, nested too deeply or of no known kind.

// GPX 1.0 and 1.1 and KML 2.2 and 2.3, by the name of the root element.
[[nodiscard]] Result<std::vector<PathDraft>> drafts_of_xml(std::string_view text, const std::string& where);

// What readsb, tar1090 and the OpenSky Network write: one JSON value, a list of them, or one on each line.
[[nodiscard]] Result<std::vector<PathDraft>> drafts_of_adsb_json(std::string_view text, const std::string& where);

// State vectors of the OpenSky Network as comma-separated values with a line of column names.
[[nodiscard]] Result<std::vector<PathDraft>> drafts_of_opensky_csv(std::string_view text, const std::string& where);

// Whether the first line of the text has the column names that drafts_of_opensky_csv() needs.
[[nodiscard]] bool is_opensky_csv(std::string_view text);

}  // namespace sigs
