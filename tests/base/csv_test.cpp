// SPDX-License-Identifier: MIT
#include "base/csv.h"

#include <doctest/doctest.h>

namespace sigs::test {

namespace {

using Fields = std::vector<std::string_view>;

}  // namespace

TEST_CASE("a line of comma-separated values has one field more than commas") {
  CHECK(csv_fields("") == Fields{""});
  CHECK(csv_fields("frame") == Fields{"frame"});
  CHECK(csv_fields("1,2.5,-3") == Fields{"1", "2.5", "-3"});
  CHECK(csv_fields(",") == Fields{"", ""});
  CHECK(csv_fields("1,,3,") == Fields{"1", "", "3", ""});
}

TEST_CASE("white space around a field and a carriage return at the line's end are not part of a field") {
  CHECK(csv_fields(" 1 ,\t2 , a b \r") == Fields{"1", "2", "a b"});
}

TEST_CASE("a field between quotes may contain commas") {
  CHECK(csv_fields("\"a,b\",c") == Fields{"a,b", "c"});
  CHECK(csv_fields(" \"a,b\" , \"\"") == Fields{"a,b", ""});
  CHECK(csv_fields("\"a \"\"b\"\"\",c") == Fields{"a \"\"b\"\"", "c"});
  CHECK(csv_fields("\"never closed,1,2") == Fields{"\"never closed,1,2"});
}

TEST_CASE("a text is quoted as a field only where it has to be") {
  CHECK(csv_field("").empty());
  CHECK(csv_field("light aircraft; 'one'") == "light aircraft; 'one'");
  CHECK(csv_field("a,b") == "\"a,b\"");
  CHECK(csv_field("say \"go\"") == "\"say \"\"go\"\"\"");
  CHECK(csv_field("two\r\nlines") == "\"two\r\nlines\"");
}

TEST_CASE("a field comes back from the line that it makes up, quotes and all") {
  for (const std::string_view text :
       {"", "plain", "a,b", "with blanks in it", "say \"go\"", "\"", "\"\"", "a\"\"b,\""}) {
    const std::string line = "x," + csv_field(text) + ",y";
    const Fields fields = csv_fields(line);
    REQUIRE(fields.size() == 3);
    CHECK(csv_text(fields[1]) == text);
  }
}

}  // namespace sigs::test
