// SPDX-License-Identifier: MIT

#include <doctest/doctest.h>
#include <clocale>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <optional>
#include <random>
#include <string>
#include <string_view>
#include <vector>

#include "base/text.h"
#include "support/comma_locale.h"
#include "support/death_test.h"

namespace sigs::test {

TEST_CASE("a number is written without zeros at its end") {
  CHECK(number_text(0, 6) == "0");
  CHECK(number_text(3, 6) == "3");
  CHECK(number_text(3.5, 6) == "3.5");
  CHECK(number_text(-12, 6) == "-12");
  CHECK(number_text(0.000001, 6) == "0.000001");
  CHECK(number_text(-0.5, 1) == "-0.5");
}

TEST_CASE("zeros before the point are kept") {
  CHECK(number_text(100, 6) == "100");
  CHECK(number_text(100, 0) == "100");
  CHECK(number_text(1e6, 0) == "1000000");
  CHECK(number_text(-250, 2) == "-250");
}

TEST_CASE("a number is rounded to the given decimals") {
  CHECK(number_text(0.1234567, 6) == "0.123457");
  CHECK(number_text(-2.0 / 3, 4) == "-0.6667");
  CHECK(number_text(0.99999996, 6) == "1");
  CHECK(number_text(9.7, 0) == "10");
}

TEST_CASE("a number that rounds to zero has no sign") {
  CHECK(number_text(-0.0, 6) == "0");
  CHECK(number_text(-0.0, 0) == "0");
  CHECK(number_text(-4e-7, 6) == "0");
  CHECK(number_text(-0.3, 0) == "0");
  CHECK(number_text(-std::numeric_limits<double>::denorm_min(), 6) == "0");
  CHECK(number_text(-6e-7, 6) == "-0.000001");
}

TEST_CASE("the largest numbers are written out without an exponent and read back") {
  for (const double number :
       {1e15, 1e100, 1e300, std::numeric_limits<double>::max(), std::numeric_limits<double>::lowest()}) {
    const std::string text = number_text(number, 6);
    CHECK(text.find_first_not_of("-0123456789") == std::string::npos);
    CHECK(std::strtod(text.c_str(), nullptr) == number);
  }
}

TEST_CASE("a written number reads back within half a unit of the last digit") {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> mantissa(-1, 1);
  for (int decimals = 0; decimals <= 9; ++decimals)
    for (int exponent = -12; exponent <= 8; ++exponent)
      for (int i = 0; i < 20; ++i) {
        const double number = mantissa(random) * std::pow(10.0, exponent);
        const double back = std::strtod(number_text(number, decimals).c_str(), nullptr);
        // The second term is the double's own rounding, which at 1e8 is some 1e-8.
        const double tolerance = 0.5 * std::pow(10.0, -decimals) + 4e-16 * std::abs(number);
        CHECK(std::abs(back - number) <= tolerance);
      }
}

TEST_CASE("numbers have a decimal point in every locale") {
  const CommaLocale comma;
  const char* const c_locale = std::setlocale(LC_ALL, nullptr);
  const std::string before = c_locale == nullptr ? "C" : c_locale;
  std::setlocale(LC_ALL, "de_DE.UTF-8");  // where the machine has it
  CHECK(number_text(1234567.25, 6) == "1234567.25");
  std::setlocale(LC_ALL, before.c_str());
}

TEST_CASE("NaN and infinity are never written") {
  for (const double number : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(),
                              -std::numeric_limits<double>::infinity()})
    CHECK(aborts([number] { static_cast<void>(number_text(number, 6)); }));
  CHECK_FALSE(aborts([] { static_cast<void>(number_text(1, 6)); }));
}

TEST_CASE("the exact text is the shortest that reads back, and empty for NaN and infinity") {
  CHECK(exact_text(0.1) == "0.1");
  CHECK(exact_text(-0.0) == "0");
  CHECK(exact_text(1.0 / 3) == "0.3333333333333333");
  CHECK(exact_text(std::numeric_limits<double>::infinity()).empty());
  CHECK(exact_text(std::optional<double>()).empty());
}

TEST_CASE("fixed texts have the digits that tables need") {
  CHECK(fixed_text(3.5, 2) == "3.50");
  CHECK(fixed_text(-0.001, 2) == "0.00");
  CHECK(fixed_text(std::numeric_limits<double>::quiet_NaN(), 2) == "-");
}

TEST_CASE("numbers are written as people write them") {
  CHECK(short_number_text(0) == "0");
  CHECK(short_number_text(-12.5) == "-12.5");
  CHECK(short_number_text(98.76543) == "98.7654");
  CHECK(short_number_text(10000) == "10000");
  CHECK(short_number_text(1e8) == "1e8");
  CHECK(short_number_text(-1.25e120) == "-1.25e120");
  CHECK(short_number_text(-3e-7) == "-3e-7");
  CHECK(short_number_text(1.5e-30) == "1.5e-30");
}

TEST_CASE("only the letters A to Z change their case") {
  CHECK(lower_case("AbZ-19 Ñ") == "abz-19 Ñ");
  CHECK(lower_case("").empty());
}

TEST_CASE("quantities are written as people say them") {
  CHECK(count_text(0, "frame") == "0 frames");
  CHECK(count_text(1, "frame") == "1 frame");
  CHECK(count_text(12, "frame") == "12 frames");
  CHECK(image_size_text({1280, 960}) == "1280x960");
  CHECK(image_size_text({1280, 960}, " x ") == "1280 x 960");
  CHECK(clock_text(0) == "0:00");
  CHECK(clock_text(5.4) == "0:05");
  CHECK(clock_text(65) == "1:05");
  CHECK(clock_text(3723) == "1:02:03");
  CHECK(clock_text(-3) == "0:00");
  CHECK(clock_text(1e300) == "2777:46:40");
  CHECK(clock_text(std::numeric_limits<double>::quiet_NaN()) == "0:00");
}

TEST_CASE("lists are joined and the byte order mark is skipped") {
  CHECK(listed(std::vector<std::string>{"a", "b", "c"}) == "a, b, c");
  CHECK(listed(std::vector<std::string_view>{}).empty());
  CHECK(without_bom("\xEF\xBB\xBFv 1") == "v 1");
  CHECK(without_bom("v 1") == "v 1");
}

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
