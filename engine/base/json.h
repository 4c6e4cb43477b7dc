// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "base/result.h"

namespace sigs {

// JSON texts read safely and written. The members of an object keep their order. The library's exceptions stay in here.

using Json = nlohmann::ordered_json;

// Parses the text of a file. The time grows with the length of the text only. Of several members of an object with the
// same key the last one counts.
//   file     named in errors
//   kind     of errors: not JSON, a number that is too large, more than kMaxNesting brackets within one another
//   doubled  filled with the keys that are in their object twice: "camera.speed_mps", "intruders.name"; null: not asked
[[nodiscard]] Result<Json> parsed_json(const std::string& text, const std::string& file, ErrorKind kind,
                                       std::vector<std::string>* doubled = nullptr);

inline constexpr const char* kIsDoubled = "is there twice; the last one counts";

// Appends the members of one object to another that has none of their keys. The time grows with the number of members,
// whereas the library's update() compares each of them with all keys.
void append_members(Json& object, Json more);

// A file's text, with a line feed at its end: NaN and infinity are written as null, bytes that are no UTF-8 as U+FFFD.
//   indent  blanks for each level; -1: all on one line
[[nodiscard]] std::string json_text(const Json& json, int indent = 2);

// A value for a message: in one line, shortened where it is longer than some 40 bytes.
[[nodiscard]] std::string shown(const Json& json);

}  // namespace sigs
