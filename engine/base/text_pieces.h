// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <string_view>

namespace sigs {

// Pieces of a text made of lines and words. White space is blank, tab and carriage return.

[[nodiscard]] inline std::string_view trimmed(std::string_view text) {
  constexpr std::string_view kSpace = " \t\r";
  const auto first = text.find_first_not_of(kSpace);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kSpace) - first + 1);
}

// Takes the first line, without its end, off the text.
[[nodiscard]] inline std::string_view next_line(std::string_view& text) {
  const auto end = text.find('\n');
  const std::string_view line = text.substr(0, end);
  text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
  return line;
}

// Takes the first word off the line; empty at its end.
[[nodiscard]] inline std::string_view next_token(std::string_view& line) {
  constexpr std::string_view kSpace = " \t\r";
  line.remove_prefix(line.find_first_not_of(kSpace) == std::string_view::npos ? line.size()
                                                                              : line.find_first_not_of(kSpace));
  const auto end = line.find_first_of(kSpace);
  const std::string_view token = line.substr(0, end);
  line.remove_prefix(token.size());
  return token;
}

// How many columns a line of UTF-8 takes on a terminal: one for each code point.
[[nodiscard]] inline std::size_t columns_of(std::string_view line) {
  return static_cast<std::size_t>(
      std::count_if(line.begin(), line.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; }));
}

}  // namespace sigs
