// SPDX-License-Identifier: MIT
#include "editor/views/readable.h"

#include <doctest/doctest.h>

#include <limits>

using sigs::editor::clock_text;
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

TEST_CASE("what is no distance is a dash") {
  CHECK(distance_text(std::numeric_limits<double>::infinity()) == "-");
  CHECK(distance_text(std::numeric_limits<double>::quiet_NaN()) == "-");
}

TEST_CASE("lengths of time are told as a clock shows them") {
  CHECK(clock_text(0) == "0:00");
  CHECK(clock_text(5.4) == "0:05");
  CHECK(clock_text(65) == "1:05");
  CHECK(clock_text(3723) == "1:02:03");
  CHECK(clock_text(-3) == "0:00");
  CHECK(clock_text(1e300) == "2777:46:40");
}
