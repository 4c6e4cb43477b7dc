// SPDX-License-Identifier: MIT
#include "evaluation/readers/text_parsing.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/parsing.h"
#include "base/text.h"

namespace sigs {

TextLines::TextLines(std::string_view text) : rest_(text) {
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  if (rest_.starts_with(kByteOrderMark)) rest_.remove_prefix(kByteOrderMark.size());
  const std::size_t last = rest_.find_last_not_of(" \t\r\n");
  rest_ = rest_.substr(0, last == std::string_view::npos ? 0 : last + 1);
}

std::optional<TextLine> TextLines::next() {
  while (!rest_.empty()) {
    const std::size_t end = rest_.find('\n');
    const std::string_view line = trimmed(rest_.substr(0, end));
    rest_.remove_prefix(end == std::string_view::npos ? rest_.size() : end + 1);
    ++number_;
    if (!line.starts_with('#')) return TextLine{number_, line};
  }
  return std::nullopt;
}

std::vector<std::string_view> number_fields(std::string_view line) {
  std::vector<std::string_view> fields;
  std::string_view rest = trimmed(line);
  while (!rest.empty()) {
    const std::size_t end = rest.find_first_of(", \t");
    fields.push_back(rest.substr(0, end));
    rest = trimmed(rest.substr(end == std::string_view::npos ? rest.size() : end));
    if (rest.starts_with(',')) rest = trimmed(rest.substr(1));
  }
  return fields;
}

std::optional<int> integer_of(double number) {
  if (!(number >= std::numeric_limits<int>::min() && number <= std::numeric_limits<int>::max())) return std::nullopt;
  if (number != std::floor(number)) return std::nullopt;
  return static_cast<int>(number);
}

std::optional<int> integer_of(std::string_view text) {
  const std::optional<double> number = parsed_number(text);
  return number ? integer_of(*number) : std::nullopt;
}

std::string in_quotes(std::string_view text) {
  constexpr std::size_t kMaxLength = 32;
  std::string shown(text.substr(0, kMaxLength));
  if (text.size() > kMaxLength) {
    std::size_t end = kMaxLength;  // not within a UTF-8 sequence
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
