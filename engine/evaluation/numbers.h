// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace sigs {

// The whole of text as a number, with a point whatever the locale; "nan" and "inf" are numbers. nullopt: it is none, or
// beyond what a double holds.
[[nodiscard]] std::optional<double> number_of(std::string_view text);

// The same for a whole number, which may be written as 7, 7.0 or 7e0. nullopt also beyond what an int holds.
[[nodiscard]] std::optional<int> integer_of(std::string_view text);
[[nodiscard]] std::optional<int> integer_of(double number);

// For messages: what stands in a file, in single quotes, at most some thirty characters of it, control characters as
// '?', so that an error stays one line.
[[nodiscard]] std::string in_quotes(std::string_view text);

// Line, counted from 1, in which the byte at offset lies.
[[nodiscard]] int line_at(std::string_view text, std::size_t offset);

}  // namespace sigs
