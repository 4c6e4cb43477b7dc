// SPDX-License-Identifier: MIT
#include "base/json.h"

#include <doctest/doctest.h>

#include <string>

using namespace sigs;

TEST_CASE("a value in a message is cut between characters, and invalid UTF-8 does no harm") {
  CHECK(shown(Json("short")) == "\"short\"");
  CHECK(shown(Json("\xff")) == "\"\xEF\xBF\xBD\"");
  std::string text;
  for (int i = 0; i < 30; ++i) text += "\xC3\xA9";
  for (const std::string before : {"", "a"}) {
    const std::string cut = shown(Json(before + text));
    CHECK(cut.size() <= 40);
    CHECK(cut.ends_with("\xC3\xA9..."));
  }
}
