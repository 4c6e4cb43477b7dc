// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

namespace sigs {

// How deep lists, objects or elements may lie in one another in a file that is read: far deeper than any file of ours,
// and far from where parsers and functions that call themselves for each level run out of stack (docs/limits.md).
inline constexpr int kMaxNesting = 100;

// How deep a text nests at most, found in one pass without calling itself. What the parser would stop at as wrong is
// not looked into further; up to there the depth is at least that which the parser goes down to.

// JSON: brackets [ and {; those in quotes do not count.
[[nodiscard]] int json_depth(std::string_view text);

// XML: elements. Comments and processing instructions do not count.
[[nodiscard]] int xml_depth(std::string_view text);

// YAML as cv::FileStorage reads it: brackets, and block lists and maps by the columns in which they begin. May count a
// level more than there is.
[[nodiscard]] int opencv_yaml_depth(std::string_view text);

}  // namespace sigs
