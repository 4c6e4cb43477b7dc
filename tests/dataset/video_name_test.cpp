// SPDX-License-Identifier: MIT
#include "base/paths.h"
#include "dataset/recipe.h"

#include <doctest/doctest.h>

using namespace sigs;

TEST_CASE("a pattern's parts are filled in and all else stays") {
  const NameParts parts{.background = "1", .aircraft = "B737", .flight = "LR", .number = 7};
  CHECK(name_from("{background}{flight}{aircraft}", parts) == "1LRB737");
  CHECK(name_from("a {number} z", parts) == "a 0007 z");
  CHECK(name_from("{flight}{flight}", parts) == "LRLR");
  CHECK(name_from("plain", parts) == "plain");
}

TEST_CASE("what a part holds is not filled in again") {
  CHECK(name_from("{background}-{aircraft}", {.background = "{aircraft}", .aircraft = "{number}", .flight = ""}) ==
        "{aircraft}-{number}");
}

TEST_CASE("numbers sort by their text and never change their width below ten thousand") {
  const auto numbered = [](int number) { return name_from("{number}", {.number = number}); };
  CHECK(numbered(1) == "0001");
  CHECK(numbered(9999) == "9999");
  CHECK(numbered(12345) == "12345");
  CHECK(numbered(99) < numbered(100));
}

TEST_CASE("a pattern with an unknown or an open part is wrong") {
  CHECK(wrong_with_pattern("{background}_{number}").empty());
  CHECK(wrong_with_pattern("{plane}") ==
        "has no such part: {plane}; there are {background}, {aircraft}, {flight} and {number}");
  CHECK(wrong_with_pattern("{}") == "has no such part: {}; there are {background}, {aircraft}, {flight} and {number}");
  CHECK(wrong_with_pattern("x{flight") == "has a { without a }");
  CHECK(!wrong_with_pattern("").empty());
}

TEST_CASE("names that cannot be files are wrong, odd ones are right") {
  for (const char* const name : {"", "a/b", "/", ".", "..", ".hidden", "a\nb", "tab\t", "\x7f"})
    CHECK_MESSAGE(!file_name_error(name).empty(), name);
  for (const char* const name : {"a", "a b", "día ñ", "<&>'\"", "x.y", "-x", "100%"})
    CHECK_MESSAGE(file_name_error(name).empty(), name);
  CHECK(file_name_error(std::string(200, 'x')).empty());
  CHECK(!file_name_error(std::string(201, 'x')).empty());
}

TEST_CASE("a video cannot have the name of another entry of the dataset") {
  for (const char* const name :
       {"labels", "splits", "index.json", "SHA256SUMS", "entry", "Labels", "INDEX.JSON", ".part", ""})
    CHECK_MESSAGE(!wrong_with_video_name(name).empty(), name);
  CHECK(wrong_with_video_name("labels2").empty());
}
