// SPDX-License-Identifier: MIT
#include "labels/label_text.h"

#include <doctest/doctest.h>

#include <nlohmann/json.hpp>
#include <string>

namespace sigs::test {

namespace {

const std::string kReplacement = "\xEF\xBF\xBD";  // U+FFFD

}  // namespace

TEST_CASE("text that XML may contain is not changed") {
  for (const char* const text : {"", "airliner", "a\tb\n", "\xC3\xA9", "\xE2\x82\xAC", "\xF0\x9F\x9B\xA9"})
    CHECK(xml_text(text) == text);
}

TEST_CASE("control characters and the two forbidden code points are replaced") {
  CHECK(xml_text("a\x01z") == "a" + kReplacement + "z");
  CHECK(xml_text(std::string_view("a\0z", 3)) == "a" + kReplacement + "z");
  CHECK(xml_text("\xEF\xBF\xBE") == kReplacement);
}

TEST_CASE("bytes that are not UTF-8 are replaced one by one and what follows is kept") {
  CHECK(xml_text("a\xFFz") == "a" + kReplacement + "z");
  CHECK(xml_text("\xC0\xAF") == kReplacement + kReplacement);                     // overlong
  CHECK(xml_text("\xED\xA0\x80") == kReplacement + kReplacement + kReplacement);  // surrogate
  CHECK(xml_text("\xE2\x82") == kReplacement + kReplacement);                     // cut short
}

TEST_CASE("names for lines and for columns") {
  CHECK(line_name("a b") == "a b");
  CHECK(line_name("  a\tb\r\nc ") == "a b  c");
  CHECK(line_name("") == "unnamed");
  CHECK(line_name(" \n") == "unnamed");
  CHECK(line_name("\xFF") == "\xEF\xBF\xBD");
  CHECK(word_name("light aircraft") == "light_aircraft");
}

TEST_CASE("frame rates as ratios and as whole numbers above 0") {
  FootageTruth footage{.frame_rate_num = 30000, .frame_rate_den = 1001};
  CHECK(rate_text(footage) == "30000/1001");
  CHECK(whole_rate_hz(footage) == 30);
  footage.frame_rate_num = 1;
  CHECK(whole_rate_hz(footage) == 1);
}

TEST_CASE("the number of frames of a range includes its last one") {
  CHECK(frame_count({.first_frame = 140, .last_frame = 142}) == 3);
  CHECK(rate_hz({.frame_rate_num = 25, .frame_rate_den = 2}) == 12.5);
}

TEST_CASE("a JSON string is one line of UTF-8 that reads back as the text") {
  for (const std::string text : {"", "say \"hello\"", "two\nlines\r", "back\\slash", "M\xC3\xBCller", "\x01"}) {
    const std::string json = json_string(text);
    CHECK(json.find_first_of("\r\n") == std::string::npos);
    CHECK(nlohmann::json::parse(json) == text);
    CHECK(json_line(nlohmann::ordered_json(text)) == json);
  }
  CHECK(json_string("M\xC3\xBCller") == "\"M\xC3\xBCller\"");
  CHECK(json_string("a\xFFz") == "\"a" + kReplacement + "z\"");
}

TEST_CASE("a JSON value is one line with its members in their order") {
  nlohmann::ordered_json json{{"z", 1}, {"a", {1.5, nullptr}}};
  CHECK(json_line(json) == R"({"z":1,"a":[1.5,null]})");
  json["a"] = "\xFF";
  CHECK(json_line(json) == R"({"z":1,"a":")" + kReplacement + R"("})");
}

TEST_CASE("markup is escaped, and what else the caller names") {
  CHECK(escaped_text("a & b <c> \"d\" 'e'") == "a &amp; b &lt;c&gt; &quot;d&quot; 'e'");
  CHECK(escaped_text("it's\ttabbed", "'\t") == "it&#39;s&#9;tabbed");
}

}  // namespace sigs::test
