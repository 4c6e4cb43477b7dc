// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "base/nesting.h"
#include "base/result.h"
#include "project/fields.h"

namespace sigs {

// JSON texts read safely, and fields from and to JSON. The library's exceptions stay in here.

using Json = nlohmann::ordered_json;

inline constexpr int kMaxJsonNesting = kMaxNesting;

// Parses the text of a file. The time grows with the length of the text only. Of several members of an object with the
// same key the last one counts.
//   file  named in errors
//   kind  of errors: not JSON, a number that is too large, more than kMaxJsonNesting brackets within one another
[[nodiscard]] Result<Json> parsed_json(const std::string& text, const std::string& file, ErrorKind kind);

// Appends the members of one object to another that has none of their keys. The time grows with the number of members,
// whereas the library's update() compares each of them with all keys.
void append_members(Json& object, Json more);

// A value for a message: in one line, shortened where it is longer than some 40 bytes.
[[nodiscard]] std::string shown(const Json& json);

// Where a key stands in a project file: "intruders[0].model.scale" -> /intruders/0/model/scale.
[[nodiscard]] Json::json_pointer pointer_of(std::string_view key);

// Sets a field to a JSON value. Returns what is wrong ("expected a number, found \"fast\""); empty where nothing is.
// Does not check ranges; validate() does.
[[nodiscard]] std::string put_json(const Json& json, const Field& field);

// The field's value as JSON.
[[nodiscard]] Json json_of(const Field& field);

}  // namespace sigs
