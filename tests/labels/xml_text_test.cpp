// SPDX-License-Identifier: MIT
#include "labels/xml_text.h"

#include <doctest/doctest.h>

#include <string>

using namespace sigs;

namespace {
const std::string kReplaced = "\xEF\xBF\xBD";  // U+FFFD
}

TEST_CASE("text that XML may hold is left as it is") {
  for (const char* const text : {"", "airliner", "a\tb\n", "\xC3\xA9", "\xE2\x82\xAC", "\xF0\x9F\x9B\xA9"})
    CHECK(xml_text(text) == text);
}

TEST_CASE("control characters and the two forbidden code points are replaced") {
  CHECK(xml_text("a\x01z") == "a" + kReplaced + "z");
  CHECK(xml_text(std::string_view("a\0z", 3)) == "a" + kReplaced + "z");
  CHECK(xml_text("\xEF\xBF\xBE") == kReplaced);
}

TEST_CASE("bytes that are no UTF-8 are replaced one by one and what follows is kept") {
  CHECK(xml_text("a\xFFz") == "a" + kReplaced + "z");
  CHECK(xml_text("\xC0\xAF") == kReplaced + kReplaced);                  // overlong
  CHECK(xml_text("\xED\xA0\x80") == kReplaced + kReplaced + kReplaced);  // surrogate
  CHECK(xml_text("\xE2\x82") == kReplaced + kReplaced);                  // cut short
}
