// SPDX-License-Identifier: MIT
#include "project/json_reading.h"

#include <algorithm>

#include "base/text_place.h"

namespace sigs {

Result<Json> parsed_json(const std::string& text, const std::string& file, ErrorKind kind) {
  if (json_depth(text) > kDeepestJson)
    return fail(file, "has more than " + std::to_string(kDeepestJson) + " brackets within one another", kind);
  try {
    return Json::parse(text);
  } catch (const Json::parse_error& error) {
    return fail(file, "is not JSON: unexpected text at " + place_of(text, error.byte), kind);
  } catch (const Json::exception&) {
    return fail(file, "holds a number that is too large", kind);
  }
}

std::string shown(const Json& json) {
  constexpr std::size_t kLongest = 40;
  std::string text = json.dump(-1, ' ', false, Json::error_handler_t::replace);
  if (text.size() <= kLongest) return text;
  std::size_t end = kLongest - 3;
  while ((static_cast<unsigned char>(text[end]) & 0xC0U) == 0x80U) --end;  // not amid a letter
  return text.substr(0, end) + "...";
}

}  // namespace sigs
