// SPDX-License-Identifier: MIT

#include <doctest/doctest.h>

#include <limits>
#include <string>

#include "editor/widgets/texts.h"

using namespace sigs::editor;

TEST_CASE("a text is cut in its middle to a number of bytes, and not where it fits") {
  CHECK(shortened("as it is", 8) == "as it is");
  CHECK(shortened("", 8).empty());
  CHECK(shortened("0123456789", 7) == "01...89");
  const std::string path = "/somewhere/" + std::string(100'000, 'x') + "/model.obj: no such file";
  const std::string shown = shortened(path);
  CHECK(shown.size() == kMaxShownText);
  CHECK(shown.starts_with("/somewhere/"));
  CHECK(shown.ends_with("/model.obj: no such file"));
  CHECK(shown.size() * 4 < 65'536);  // vertices of a letter, what an index can count
}

TEST_CASE("a text is never cut between the bytes of one character") {
  std::string text;
  for (int i = 0; i < 50; ++i) text += "\u20ac";  // three bytes each
  for (std::size_t maximum = 4; maximum < 60; ++maximum) {
    std::string shown = shortened(text, maximum);
    CHECK(shown.size() <= maximum);
    const std::size_t dots = shown.find("...");
    REQUIRE(dots != std::string::npos);
    CHECK(dots % 3 == 0);
    CHECK((shown.size() - dots - 3) % 3 == 0);
  }
}

using sigs::editor::distance_text;

TEST_CASE("distances have three digits or four, and the unit that suits them") {
  CHECK(distance_text(0) == "0.00 m");
  CHECK(distance_text(0.126) == "0.13 m");
  CHECK(distance_text(9.994) == "9.99 m");
  CHECK(distance_text(9.996) == "10.0 m");
  CHECK(distance_text(999.94) == "999.9 m");
  CHECK(distance_text(999.96) == "1000 m");
  CHECK(distance_text(9999.4) == "9999 m");
  CHECK(distance_text(9999.6) == "10.0 km");
  CHECK(distance_text(14'177'000) == "14177 km");
}

TEST_CASE("a distance that is not finite is a dash") {
  CHECK(distance_text(std::numeric_limits<double>::infinity()) == "-");
  CHECK(distance_text(std::numeric_limits<double>::quiet_NaN()) == "-");
}
