// SPDX-License-Identifier: MIT
#include "base/xml_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <optional>

namespace sigs {

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
