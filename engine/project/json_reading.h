// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "base/nesting.h"
#include "base/result.h"
#include "project/field_json.h"

namespace sigs {

inline constexpr int kMaxJsonNesting = kMaxNesting;

// The text of a file as JSON; what is wrong with it is an error of this kind, which names the file.
[[nodiscard]] Result<Json> parsed_json(const std::string& text, const std::string& file, ErrorKind kind);

// Puts the members of one object behind those of another, which has none of their keys; in time that grows with their
// number, where the library's update() looks through all keys for each.
void append_members(Json& object, Json more);

// A value for a message: in one line, its beginning where it is longer than some 40 bytes.
[[nodiscard]] std::string shown(const Json& json);

}  // namespace sigs
