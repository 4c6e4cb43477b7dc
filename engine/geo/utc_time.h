// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace sigs {

// Instants in UTC: seconds since 1970-01-01T00:00:00Z, without leap seconds, as text and back.

// The years 0001 to 9999, which are all that texts can have.
inline constexpr double kFirstUtc_s = -62135596800.0;
inline constexpr double kLastUtc_s = 253402300799.0;

struct UtcInstant {
  double time_s = 0;
  bool has_zone = false;  // the text ends with Z or an offset, as +02:00; without one the time is taken for UTC
};

// The beginning of a day of the Gregorian calendar; nullopt where there is no such day.
[[nodiscard]] std::optional<double> utc_of_day(int year, int month, int day);

// An instant as XML Schema's dateTime, date, gYearMonth or gYear have it (https://www.w3.org/TR/xmlschema-2), which are
// what GPX and KML allow: 2026-05-01T12:00:00.25Z, 2026-05-01T14:00:00+02:00, 2026-05-01, 2026-05, 2026. A blank may
// stand in place of the T. Second 60 is that after 59. White space around it is ignored. nullopt: no such text or day.
[[nodiscard]] std::optional<UtcInstant> utc_instant_of(std::string_view text);

// "2026-05-01T12:00:00.25Z": at most six decimals of a second. Beyond the years 1 to 9999 the nearest instant in them;
// the time must not be NaN.
[[nodiscard]] std::string utc_text(double time_s);

}  // namespace sigs
