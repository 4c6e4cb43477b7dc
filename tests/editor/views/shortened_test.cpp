// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <string>

#include "editor/widgets/elided.h"

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
