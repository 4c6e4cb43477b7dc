// SPDX-License-Identifier: MIT
#include "geo/utc_time.h"

#include <doctest/doctest.h>

#include <cmath>
#include <string>
#include <vector>

#include "support/process.h"

using namespace sigs;
using namespace sigs::test;

namespace {

double seconds_of(const std::string& text) {
  const std::optional<UtcInstant> instant = utc_instant_of(text);
  REQUIRE_MESSAGE(instant.has_value(), text);
  return instant->time_s;
}

}  // namespace

TEST_CASE("instants are those of the program date") {
  for (const std::string text :
       {"1970-01-01T00:00:00Z", "2000-02-29T23:59:59Z", "2026-05-01T14:00:00+02:00", "1969-12-31T23:59:59-05:30",
        "2100-03-01T00:00:00Z", "0001-01-01T00:00:00Z", "9999-12-31T23:59:59Z"}) {
    const Run date = run_command("date -u -d '" + text + "' +%s");
    REQUIRE(date.status == 0);
    CHECK_MESSAGE(seconds_of(text) == std::stod(date.out), text);
  }
}

TEST_CASE("an instant is read with parts of a second, and as a day, month or year alone") {
  CHECK(seconds_of(" 1970-01-01T00:00:01.25Z\n") == 1.25);
  CHECK(seconds_of("1970-01-02") == 86400);
  CHECK(seconds_of("1970-02") == 31 * 86400);
  CHECK(seconds_of("1971") == 365 * 86400);
  CHECK(seconds_of("1970-01-01 00:01Z") == 60);
  CHECK(utc_instant_of("2026-05-01T12:00:00Z")->has_zone);
  CHECK_FALSE(utc_instant_of("2026-05-01T12:00:00")->has_zone);
}

TEST_CASE("what is no instant is refused") {
  for (const std::string text :
       {"", " ", "x", "2026-13-01", "2025-02-29", "2026-05-01T25:00:00Z", "2026-05-01T12:60:00Z",
        "2026-05-01T24:59:60Z", "2026-05-01T24:00:01Z", "2026-05-01T22:59:60Z", "2026-05-01T12:00:00Q",
        "2026-05-01T12:00:00.Z", "2026-05-01T12:00:00+", "20260501T120000Z", "0000-01-01", "2026-05-01T12:00:00Zx"})
    CHECK_MESSAGE(!utc_instant_of(text).has_value(), text);
}

TEST_CASE("an instant written is read back to the microsecond") {
  for (const double time_s : {0.0, 0.5, -0.25, 1777636800.123456, 1e9, 946684800.0, -62135596800.0, 253402300799.0,
                              1.9999999, 1777636799.9999999})
    CHECK(std::abs(seconds_of(utc_text(time_s)) - time_s) < 1e-6);
  CHECK(utc_text(0) == "1970-01-01T00:00:00Z");
  CHECK(utc_text(0.25) == "1970-01-01T00:00:00.25Z");
  CHECK(utc_text(1e30) == "9999-12-31T23:59:59Z");
  CHECK(utc_text(-1e30) == "0001-01-01T00:00:00Z");
}
