// SPDX-License-Identifier: MIT
#pragma once

#include <charconv>
#include <string>

namespace sigs {

// A number for people to read: six digits, a point whatever the language, 1e8 rather than 1e+08.
[[nodiscard]] inline std::string short_text(double number) {
  char buffer[32];
  std::string text(buffer, std::to_chars(buffer, buffer + sizeof buffer, number, std::chars_format::general, 6).ptr);
  const std::size_t exponent = text.find('e');
  if (exponent == std::string::npos) return text;
  text.erase(exponent + 1, text.find_first_not_of("+0", exponent + 1) - exponent - 1);  // 1e+08
  if (text[exponent + 1] == '-') text.erase(exponent + 2, text.find_first_not_of('0', exponent + 2) - exponent - 2);
  return text;
}

}  // namespace sigs
