// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"

namespace sigs {

// What the readers of encounter files share: units, and numbers with their line and column in errors.

enum class UnitKind { none, length, angle, speed, time };

// A unit as a factor to m, rad, m/s or s.
struct FileUnit {
  UnitKind kind = UnitKind::none;
  double factor = 1;
};

// "[ft]", "ft", "knot", "fpm", "ft/min", "ftps", "deg", "unitless" and so on, in any case; none for another word.
[[nodiscard]] std::optional<FileUnit> file_unit(std::string_view text);

// A finite number, with a sign and an exponent where it has them; none for anything else.
[[nodiscard]] std::optional<double> file_number(std::string_view text);

// Seconds, or a time of day "h:m:s" as seconds.
[[nodiscard]] std::optional<double> file_time_s(std::string_view text);

// The values of a line. Where it has a comma or a semicolon, these separate and an empty value counts; else white space
// does.
[[nodiscard]] std::vector<std::string_view> file_values(std::string_view line);

// "pair.daa: line 7, column gs": the place for an error.
[[nodiscard]] std::string file_place(const std::string& file, int line, std::string_view column);

// The beginning of a value for a message, without control characters.
[[nodiscard]] std::string shown_value(std::string_view text);

}  // namespace sigs
