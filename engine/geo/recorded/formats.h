// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "geo/recorded/path_draft.h"

namespace sigs {

// One reader for each kind of text. Each returns what the text says, unchecked; all_repaired() checks it.
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
