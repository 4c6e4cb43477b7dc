// SPDX-License-Identifier: MIT
#include "encounter/file_columns.h"
#include "base/parsing.h"
#include "encounter/well_clear.h"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "base/text.h"

namespace sigs {

namespace {

struct NamedUnit {
  std::string_view name;
  FileUnit unit;
};

constexpr double kMile_m = 1852;  // nautical

// Names that DAIDALUS and the pairing programs of MIT Lincoln Laboratory write.
constexpr auto kUnits = std::to_array<NamedUnit>({
    {"unitless", {UnitKind::none, 1}},
    {"none", {UnitKind::none, 1}},
    {"-", {UnitKind::none, 1}},
    {"", {UnitKind::none, 1}},
    {"m", {UnitKind::length, 1}},
    {"km", {UnitKind::length, 1000}},
    {"ft", {UnitKind::length, kFoot_m}},
    {"feet", {UnitKind::length, kFoot_m}},
    {"nmi", {UnitKind::length, kMile_m}},
    {"nm", {UnitKind::length, kMile_m}},
    {"deg", {UnitKind::angle, kDegree_rad}},
    {"degree", {UnitKind::angle, kDegree_rad}},
    {"rad", {UnitKind::angle, 1}},
    {"m/s", {UnitKind::speed, 1}},
    {"mps", {UnitKind::speed, 1}},
    {"m/min", {UnitKind::speed, 1.0 / 60}},
    {"km/h", {UnitKind::speed, 1 / 3.6}},
    {"kmh", {UnitKind::speed, 1 / 3.6}},
    {"kph", {UnitKind::speed, 1 / 3.6}},
    {"ft/s", {UnitKind::speed, kFoot_m}},
    {"fps", {UnitKind::speed, kFoot_m}},
    {"ftps", {UnitKind::speed, kFoot_m}},
    {"fpm", {UnitKind::speed, kFoot_m / 60}},
    {"ft/min", {UnitKind::speed, kFoot_m / 60}},
    {"knot", {UnitKind::speed, kMile_m / 3600}},
    {"knots", {UnitKind::speed, kMile_m / 3600}},
    {"kt", {UnitKind::speed, kMile_m / 3600}},
    {"kts", {UnitKind::speed, kMile_m / 3600}},
    {"kn", {UnitKind::speed, kMile_m / 3600}},
    {"s", {UnitKind::time, 1}},
    {"sec", {UnitKind::time, 1}},
    {"ms", {UnitKind::time, 1e-3}},
    {"min", {UnitKind::time, 60}},
    {"h", {UnitKind::time, 3600}},
    {"hr", {UnitKind::time, 3600}},
});

}  // namespace

std::optional<FileUnit> file_unit(std::string_view text) {
  text = trimmed(text);
  if (text.size() >= 2 && text.front() == '[' && text.back() == ']') text = trimmed(text.substr(1, text.size() - 2));
  const std::string name = lower_case(text);
  for (const NamedUnit& unit : kUnits)
    if (unit.name == name) return unit.unit;
  return {};
}

std::optional<double> file_number(std::string_view text) {
  return finite_number(trimmed(text));
}

std::optional<double> file_time_s(std::string_view text) {
  text = trimmed(text);
  const std::size_t first = text.find(':');
  if (first == std::string_view::npos) return file_number(text);
  const std::size_t second = text.find(':', first + 1);
  if (second == std::string_view::npos) return {};
  const std::optional<double> hours = file_number(text.substr(0, first));
  const std::optional<double> minutes = file_number(text.substr(first + 1, second - first - 1));
  const std::optional<double> seconds = file_number(text.substr(second + 1));
  if (!hours || !minutes || !seconds || *hours < 0 || *minutes < 0 || *minutes >= 60 || *seconds < 0 || *seconds >= 61)
    return {};
  return 3600 * *hours + 60 * *minutes + *seconds;
}

std::vector<std::string_view> file_values(std::string_view line) {
  std::vector<std::string_view> values;
  if (line.find_first_of(",;") == std::string_view::npos) {
    for (std::string_view word = next_token(line); !word.empty(); word = next_token(line)) values.push_back(word);
    return values;
  }
  for (;;) {
    const std::size_t end = line.find_first_of(",;");
    values.push_back(trimmed(line.substr(0, end)));
    if (end == std::string_view::npos) return values;
    line.remove_prefix(end + 1);
  }
}

std::string file_place(const std::string& file, int line, std::string_view column) {
  return column.empty() ? fmt::format("{}: line {}", file, line)
                        : fmt::format("{}: line {}, column {}", file, line, shown_value(column));
}

std::string shown_value(std::string_view text) {
  constexpr std::size_t kMost = 40;
  std::string shown(text.substr(0, kMost));
  for (char& c : shown)
    if (static_cast<unsigned char>(c) < 32 || c == 127) c = '?';
  return text.size() > kMost ? shown + "..." : shown;
}

}  // namespace sigs
