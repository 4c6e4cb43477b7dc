// SPDX-License-Identifier: MIT
#include "base/result.h"

#include <doctest/doctest.h>

using namespace sigs;

TEST_CASE("an error or a warning is one line of UTF-8 without control characters, whatever it quotes") {
  const std::string hostile = "a\nb\x1B[31m\x7F\r\tc\xFF";
  const std::string shown = "f: a b\xEF\xBF\xBD[31m   c\xEF\xBF\xBD";
  CHECK(Error{"f", hostile}.text() == shown);
  CHECK(Warning{"f", hostile}.text() == shown);
  const std::string long_line = Error{"file", std::string(1'000'000, 'x') + ": shorten it"}.text();
  CHECK(long_line.size() < 5000);
  CHECK(long_line.starts_with("file: xxx"));
  CHECK(long_line.ends_with("x: shorten it"));
  CHECK(Error{"", "gr\xC3\xBC\xC3\x9F dich"}.text() == "gr\xC3\xBC\xC3\x9F dich");
}
