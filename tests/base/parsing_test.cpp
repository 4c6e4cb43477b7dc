// SPDX-License-Identifier: MIT
#include "base/parsing.h"

#include <doctest/doctest.h>

#include <cstdint>
#include <string>

using namespace sigs;

TEST_CASE("the whole of a text is a number, or none") {
  CHECK(parsed_number("1.5") == 1.5);
  CHECK(parsed_number("-2e3") == -2000);
  CHECK(parsed_number("+7") == 7);
  CHECK(parsed_number<int>("42") == 42);
  CHECK(parsed_number<std::uint8_t>("255") == 255);
  for (const char* text : {"", "+", "-", "+-1", "++1", "1 ", " 1", "1,5", "1.5x", "0x10", "1e", "1e999", "one"})
    CHECK_MESSAGE(!parsed_number(text), text);
  for (const char* text : {"1.0", "99999999999", "1e2"}) CHECK_MESSAGE(!parsed_number<int>(text), text);
  CHECK_FALSE(parsed_number<std::uint8_t>("256"));
  CHECK_FALSE(parsed_number(std::string_view("1\0", 2)));
}

TEST_CASE("finite numbers are those that are neither nan nor inf") {
  CHECK(finite_number("-0.25") == -0.25);
  CHECK(std::isnan(*parsed_number("nan")));
  CHECK(std::isinf(*parsed_number("-inf")));
  for (const char* text : {"nan", "inf", "-inf", "infinity", "NaN", ""}) CHECK_MESSAGE(!finite_number(text), text);
}
