// SPDX-License-Identifier: MIT
#include "evaluation/text_lines.h"

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

void split_numbers(std::string_view line, std::vector<std::string_view>& fields) {
  fields.clear();
  std::string_view rest = trimmed(line);
  while (!rest.empty()) {
    const std::size_t end = rest.find_first_of(", \t");
    fields.push_back(rest.substr(0, end));
    rest = trimmed(rest.substr(end == std::string_view::npos ? rest.size() : end));
    if (rest.starts_with(',')) rest = trimmed(rest.substr(1));
  }
}

void split_values(std::string_view line, std::vector<std::string_view>& fields) {
  fields.clear();
  std::size_t begin = 0;
  bool is_quoted = false;
  for (std::size_t i = 0; i <= line.size(); ++i) {
    if (i < line.size() && line[i] == '"') is_quoted = !is_quoted;
    if (i < line.size() && (is_quoted || line[i] != ',')) continue;
    std::string_view field = trimmed(line.substr(begin, i - begin));
    if (field.size() >= 2 && field.front() == '"' && field.back() == '"') field = field.substr(1, field.size() - 2);
    fields.push_back(field);
    begin = i + 1;
  }
}

}  // namespace sigs
