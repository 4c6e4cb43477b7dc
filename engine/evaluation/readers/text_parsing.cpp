// SPDX-License-Identifier: MIT
#include "evaluation/readers/text_parsing.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/text.h"

namespace sigs {

TextLines::TextLines(std::string_view text) : rest_(without_bom(text)) {
  const std::size_t last = rest_.find_last_not_of(" \t\r\n");
  rest_ = rest_.substr(0, last == std::string_view::npos ? 0 : last + 1);
}

std::optional<TextLine> TextLines::next() {
  while (!rest_.empty()) {
    const std::string_view line = trimmed(next_line(rest_));
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

std::optional<KeyAndValue> key_and_value(std::string_view line) {
  const std::size_t equals = line.find('=');
  if (equals == std::string_view::npos) return std::nullopt;
  return KeyAndValue{trimmed(line.substr(0, equals)), trimmed(line.substr(equals + 1))};
}

Box box_around(std::span<const double> corners) {
  double low[2] = {corners[0], corners[1]};
  double high[2] = {corners[0], corners[1]};
  for (std::size_t i = 0; i < corners.size(); ++i) {
    if (std::isnan(corners[i])) low[i % 2] = high[i % 2] = corners[i];
    low[i % 2] = std::min(low[i % 2], corners[i]);
    high[i % 2] = std::max(high[i % 2], corners[i]);
  }
  return {low[0], low[1], high[0] - low[0], high[1] - low[1]};
}

std::string place_of(const std::filesystem::path& path, int line) {
  return fmt::format("{}: line {}", path.string(), line);
}

int line_at(std::string_view text, std::size_t offset) {
  return 1 + static_cast<int>(std::ranges::count(text.substr(0, offset), '\n'));
}

}  // namespace sigs
