// SPDX-License-Identifier: MIT
#include "evaluation/numbers.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

namespace sigs {

std::optional<double> number_of(std::string_view text) {
  if (text.starts_with('+') && !text.starts_with("+-")) text.remove_prefix(1);  // from_chars takes no plus sign
  double number = 0;
  const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (code != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return number;
}

std::optional<int> integer_of(double number) {
  if (!(number >= std::numeric_limits<int>::min() && number <= std::numeric_limits<int>::max())) return std::nullopt;
  if (number != std::floor(number)) return std::nullopt;
  return static_cast<int>(number);
}

std::optional<int> integer_of(std::string_view text) {
  const std::optional<double> number = number_of(text);
  return number ? integer_of(*number) : std::nullopt;
}

std::string in_quotes(std::string_view text) {
  constexpr std::size_t kMaxLength = 32;
  std::string shown(text.substr(0, kMaxLength));
  if (text.size() > kMaxLength) {
    std::size_t end = kMaxLength;  // not amid a UTF-8 sequence
    while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0) == 0x80) --end;
    shown.resize(end);
    shown += "...";
  }
  std::ranges::replace_if(
      shown, [](char letter) { return static_cast<unsigned char>(letter) < 0x20 || letter == 0x7F; }, '?');
  return "'" + shown + "'";
}

int line_at(std::string_view text, std::size_t offset) {
  return 1 + static_cast<int>(std::ranges::count(text.substr(0, offset), '\n'));
}

}  // namespace sigs
