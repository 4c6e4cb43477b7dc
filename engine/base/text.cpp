// SPDX-License-Identifier: MIT
#include "base/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>

#include "base/ensure.h"

namespace sigs {

namespace {

constexpr std::string_view kSpace = " \t\r";

// What std::to_chars writes. A fixed notation takes 309 digits before the point at most.
template <class... Format>
std::string chars_of(double number, Format... format) {
  std::array<char, 400> buffer{};
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), number, format...);
  return {buffer.data(), end.ptr};
}

}  // namespace

std::string_view trimmed(std::string_view text, std::string_view space) {
  const auto first = text.find_first_not_of(space);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(space) - first + 1);
}

std::string_view without_bom(std::string_view text) {
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  if (text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
  return text;
}

std::string_view next_line(std::string_view& text) {
  const auto end = text.find('\n');
  const std::string_view line = text.substr(0, end);
  text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
  return line;
}

std::string_view next_token(std::string_view& line) {
  line.remove_prefix(std::min(line.find_first_not_of(kSpace), line.size()));
  const std::string_view token = line.substr(0, line.find_first_of(kSpace));
  line.remove_prefix(token.size());
  return token;
}

std::size_t columns_of(std::string_view line) {
  return static_cast<std::size_t>(
      std::count_if(line.begin(), line.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; }));
}

std::string lower_case(std::string_view text) {
  std::string lower(text);
  for (char& letter : lower)
    if (letter >= 'A' && letter <= 'Z') letter = static_cast<char>(letter - 'A' + 'a');
  return lower;
}

std::string text_position(std::string_view text, std::size_t byte) {
  const std::string_view before = text.substr(0, std::min(byte > 0 ? byte - 1 : 0, text.size()));
  const auto line = std::count(before.begin(), before.end(), '\n') + 1;
  const std::size_t line_break = before.rfind('\n');
  const std::size_t column = before.size() - (line_break == std::string_view::npos ? 0 : line_break + 1) + 1;
  return fmt::format("line {}, column {}", line, column);
}

std::string exact_text(double number) {
  if (!std::isfinite(number)) return "";
  return chars_of(number == 0 ? 0.0 : number);
}

std::string exact_text(const std::optional<double>& number) {
  return number ? exact_text(*number) : std::string();
}

std::string number_text(double number, int decimals) {
  ENSURE(std::isfinite(number));
  std::string text = chars_of(number, std::chars_format::fixed, decimals);
  if (text.find('.') != std::string::npos) {
    text.erase(text.find_last_not_of('0') + 1);
    if (text.back() == '.') text.pop_back();
  }
  return text == "-0" ? "0" : text;
}

std::string fixed_text(double number, int decimals) {
  if (!std::isfinite(number)) return "-";
  std::string text = chars_of(number, std::chars_format::fixed, decimals);
  const bool is_zero = text.find_first_of("123456789") == std::string::npos;
  if (is_zero && text.starts_with('-')) text.erase(0, 1);
  return text;
}

std::string short_number_text(double number) {
  std::string text = chars_of(number, std::chars_format::general, 6);
  const std::size_t exponent = text.find('e');
  if (exponent == std::string::npos) return text;
  text.erase(exponent + 1, text.find_first_not_of("+0", exponent + 1) - exponent - 1);  // 1e+08
  if (text[exponent + 1] == '-') text.erase(exponent + 2, text.find_first_not_of('0', exponent + 2) - exponent - 2);
  return text;
}

std::string image_size_text(cv::Size size_px, std::string_view between) {
  return fmt::format("{}{}{}", size_px.width, between, size_px.height);
}

std::string clock_text(double seconds) {
  const long whole = std::lround(std::min(std::max(0.0, seconds), 1e7));
  if (whole >= 3600) return fmt::format("{}:{:02}:{:02}", whole / 3600, whole / 60 % 60, whole % 60);
  return fmt::format("{}:{:02}", whole / 60, whole % 60);
}

std::vector<std::string_view> csv_fields(std::string_view line) {
  std::vector<std::string_view> fields;
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
  return fields;
}

std::string csv_text(std::string_view field) {
  std::string text;
  for (std::size_t i = 0; i < field.size(); ++i) {
    text += field[i];
    if (field.substr(i, 2) == "\"\"") ++i;
  }
  return text;
}

std::string csv_field(std::string_view text) {
  if (text.find_first_of(",\"\r\n") == std::string_view::npos) return std::string(text);
  std::string field = "\"";
  for (const char c : text) {
    if (c == '"') field += '"';
    field += c;
  }
  return field + '"';
}

namespace {

struct DecodedCharacter {
  std::uint32_t point = 0;
  std::size_t bytes = 1;
};

// The first code point of well-formed UTF-8 (RFC 3629): no overlong forms, no surrogates, none above U+10FFFF.
std::optional<DecodedCharacter> decoded_character(std::string_view text) {
  const auto byte = [&text](std::size_t i) { return static_cast<std::uint32_t>(static_cast<unsigned char>(text[i])); };
  const std::uint32_t first = byte(0);
  if (first < 0x80) return DecodedCharacter{first, 1};
  const std::size_t bytes = first >= 0xF0 ? 4 : first >= 0xE0 ? 3 : 2;
  if (first < 0xC2 || first > 0xF4 || text.size() < bytes) return std::nullopt;
  std::uint32_t point = first & (0x7FU >> bytes);
  for (std::size_t i = 1; i < bytes; ++i) {
    if ((byte(i) & 0xC0U) != 0x80U) return std::nullopt;
    point = point << 6U | (byte(i) & 0x3FU);
  }
  const std::uint32_t min_point = bytes == 2 ? 0x80 : bytes == 3 ? 0x800 : 0x10000;
  const bool is_surrogate = point >= 0xD800 && point <= 0xDFFF;
  if (point < min_point || point > 0x10FFFF || is_surrogate) return std::nullopt;
  return DecodedCharacter{point, bytes};
}

bool is_allowed_in_xml(std::uint32_t point) {
  if (point < 0x20) return point == 0x9 || point == 0xA || point == 0xD;
  return point != 0xFFFE && point != 0xFFFF;
}

}  // namespace

std::string xml_text(std::string_view text) {
  std::string out;
  for (std::size_t i = 0; i < text.size();) {
    const std::optional<DecodedCharacter> character = decoded_character(text.substr(i));
    if (character && is_allowed_in_xml(character->point))
      out += text.substr(i, character->bytes);
    else
      out += "\xEF\xBF\xBD";
    i += character ? character->bytes : 1;
  }
  return out;
}

std::string line_text(std::string_view text) {
  std::string line = xml_text(text);
  std::replace_if(
      line.begin(), line.end(), [](char c) { return static_cast<unsigned char>(c) < ' ' || c == '\x7F'; }, ' ');
  return line;
}

std::string escaped_text(std::string_view text, std::string_view also) {
  std::string out;
  for (const char c : text) {
    if (c == '&')
      out += "&amp;";
    else if (c == '<')
      out += "&lt;";
    else if (c == '>')
      out += "&gt;";
    else if (c == '"')
      out += "&quot;";
    else if (also.find(c) != std::string_view::npos)
      out += fmt::format("&#{};", static_cast<int>(c));
    else
      out += c;
  }
  return out;
}

}  // namespace sigs
