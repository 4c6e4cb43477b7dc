// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

#include "base/result.h"
#include "project/field_json.h"

namespace sigs {

// How deep lists and objects may lie in one another: far deeper than any file of ours, and far from where the functions
// that go down into them would run out of stack.
inline constexpr int kDeepestJson = 100;

// How deep lists and objects lie in one another at most, by their brackets alone.
[[nodiscard]] int json_depth(std::string_view text);

// The text of a file as JSON; what is wrong with it is an error of this kind, which names the file.
[[nodiscard]] Result<Json> parsed_json(const std::string& text, const std::string& file, ErrorKind kind);

// A value for a message: in one line, its beginning where it is longer than some 40 bytes.
[[nodiscard]] std::string shown(const Json& json);

}  // namespace sigs
