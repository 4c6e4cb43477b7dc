// SPDX-License-Identifier: MIT
#include "dataset/short_text.h"

#include <doctest/doctest.h>

using namespace sigs;

TEST_CASE("numbers have at most six digits and short exponents") {
  CHECK(short_text(0) == "0");
  CHECK(short_text(-12.5) == "-12.5");
  CHECK(short_text(98.76543) == "98.7654");
  CHECK(short_text(10000) == "10000");
  CHECK(short_text(1e7) == "1e7");
  CHECK(short_text(-1.25e120) == "-1.25e120");
  CHECK(short_text(3e-7) == "3e-7");
  CHECK(short_text(1.5e-30) == "1.5e-30");
}
