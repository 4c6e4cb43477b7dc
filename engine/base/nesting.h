// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

namespace sigs {

// The greatest depth to which lists, objects or elements may be nested in a file that is read. It is far more than any
// file of ours has, and far less than exhausts the stack of parsers and other recursive functions (docs/limits.md).
inline constexpr int kMaxNesting = 100;

// The functions below return the greatest depth to which a text is nested. They need one pass and no recursion. Text
// behind a syntax error is not examined further; up to there the result is at least the depth to which a parser
// descends.

// JSON: brackets [ and {, except in quoted strings.
[[nodiscard]] int json_depth(std::string_view text);

// XML: elements; comments and processing instructions are ignored.
[[nodiscard]] int xml_depth(std::string_view text);

}  // namespace sigs
