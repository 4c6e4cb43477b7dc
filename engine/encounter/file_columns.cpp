// SPDX-License-Identifier: MIT
#include "encounter/daa_file.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <map>

#include "base/text.h"
#include "encounter/well_clear.h"

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

// With a sign and an exponent where it has them.
std::optional<double> file_number(std::string_view text) {
  return finite_number(trimmed(text));
}

}  // namespace

std::optional<FileUnit> file_unit(std::string_view text) {
  text = trimmed(text);
  if (text.size() >= 2 && text.front() == '[' && text.back() == ']') text = trimmed(text.substr(1, text.size() - 2));
  const std::string name = lower_case(text);
  for (const NamedUnit& unit : kUnits)
    if (unit.name == name) return unit.unit;
  return {};
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

namespace {

constexpr double kMost = 1e9;  // metres, m/s

// Numbers of a line for both aircraft: north, east, down and the velocity along them.
constexpr std::size_t kPerAircraft = 6;
constexpr std::array<std::string_view, kPerAircraft> kQuantities{"north", "east", "alt", "vnorth", "veast", "vup"};

struct PairColumn {
  std::string name;
  int slot = -1;      // aircraft * kPerAircraft + quantity; -1: the time; -2: not read
  double factor = 1;  // down is negative up
};

std::optional<PairColumn> column_of(std::string_view name) {
  std::string lower = lower_case(name);
  PairColumn column{.name = std::string(name)};
  if (lower == "t_s" || lower == "time_s") return column;
  const int aircraft = lower.starts_with("own_") ? 0 : lower.starts_with("int_") ? 1 : -1;
  const std::size_t end = lower.rfind('_');
  if (aircraft < 0 || end <= 4) return {};
  std::string quantity = lower.substr(4, end - 4);
  if (quantity == "up") quantity = "alt";
  const std::optional<FileUnit> unit = file_unit(lower.substr(end + 1));
  for (std::size_t i = 0; i < kPerAircraft; ++i) {
    if (kQuantities[i] != quantity) continue;
    if (!unit || unit->kind != (i < 3 ? UnitKind::length : UnitKind::speed)) return {};
    column.slot = aircraft * static_cast<int>(kPerAircraft) + static_cast<int>(i);
    column.factor = i % 3 == 2 ? -unit->factor : unit->factor;
    return column;
  }
  return {};
}

struct PairHeader {
  std::vector<PairColumn> columns;
  bool has_velocities = false;
};

Result<PairHeader> pair_header_of(std::string_view line, int number, EncounterFile& read, const std::string& file) {
  PairHeader header;
  std::map<int, int> count_of_slot;
  for (const std::string_view name : csv_fields(line)) {
    std::optional<PairColumn> column = column_of(name);
    if (!column) {
      read.warnings.push_back({file_place(file, number, name), "is not read"});
      column = PairColumn{.name = std::string(name), .slot = -2};
    } else if (++count_of_slot[column->slot] > 1) {
      return fail(file_place(file, number, name), "is a second column of the same quantity");
    }
    header.columns.push_back(*column);
  }
  if (!count_of_slot.contains(-1)) return fail(file_place(file, number, ""), "needs the column t_s");
  int velocities = 0;
  for (int slot = 0; slot < 2 * static_cast<int>(kPerAircraft); ++slot) {
    const int quantity = slot % static_cast<int>(kPerAircraft);
    if (quantity >= 3)
      velocities += count_of_slot.contains(slot) ? 1 : 0;
    else if (!count_of_slot.contains(slot))
      return fail(file_place(file, number, ""),
                  fmt::format("needs the column {0}_{1} with its unit, as {0}_{1}_ft",
                              slot < static_cast<int>(kPerAircraft) ? "own" : "int", kQuantities[quantity]));
  }
  if (velocities != 0 && velocities != 6)
    return fail(
        file_place(file, number, ""),
        "has some of the columns of the velocities; vnorth, veast and vup of both aircraft, or none, are needed");
  header.has_velocities = velocities == 6;
  return header;
}

struct PairLine {
  double time_s = 0;
  std::array<double, 2 * kPerAircraft> numbers = {};

  [[nodiscard]] TrackSample sample(std::size_t aircraft) const {
    const double* const n = &numbers[aircraft * kPerAircraft];
    return {time_s, {{n[0], n[1], n[2]}, {n[3], n[4], n[5]}}};
  }
};

Result<PairLine> pair_line_of(std::string_view text, const PairHeader& header, int number, const std::string& file) {
  const std::vector<std::string_view> values = csv_fields(text);
  if (values.size() != header.columns.size())
    return fail(file_place(file, number, ""),
                fmt::format("has {}, {} are expected", count_text(std::ssize(values), "value"), header.columns.size()));
  PairLine line;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const PairColumn& column = header.columns[i];
    if (column.slot == -2) continue;
    const std::optional<double> value = file_number(values[i]);
    if (!value)
      return fail(file_place(file, number, column.name),
                  fmt::format("\"{}\" is no finite number", shown_value(values[i])));
    if (std::abs(*value * column.factor) > (column.slot == -1 ? 1e12 : kMost))
      return fail(file_place(file, number, column.name),
                  fmt::format("{} is beyond what it can be", shown_value(values[i])));
    if (column.slot == -1)
      line.time_s = *value;
    else
      line.numbers[static_cast<std::size_t>(column.slot)] = *value * column.factor;
  }
  return line;
}

}  // namespace

Result<EncounterFile> parse_pair_csv(std::string_view text, const std::string& file) {
  EncounterFile read;
  text = without_bom(text);
  int number = 0;
  std::optional<PairHeader> header;
  read.tracks = {{.name = "ownship"}, {.name = "intruder"}};
  while (!text.empty()) {
    ++number;
    const std::string_view line = trimmed(next_line(text));
    if (line.empty() || line.front() == '#') continue;
    if (!header) {
      Result<PairHeader> first = pair_header_of(line, number, read, file);
      if (!first) return fail(first.error());
      header = *std::move(first);
      continue;
    }
    const Result<PairLine> values = pair_line_of(line, *header, number, file);
    if (!values) return fail(values.error());
    for (std::size_t i = 0; i < 2; ++i) {
      std::vector<TrackSample>& samples = read.tracks[i].samples;
      if (!samples.empty() && values->time_s <= samples.back().time_s)
        return fail(file_place(file, number, "t_s"),
                    fmt::format("{} s is not after {} s, the time of the line before it", exact_text(values->time_s),
                                exact_text(samples.back().time_s)));
      read.tracks[i].has_velocities = header->has_velocities;
      samples.push_back(values->sample(i));
    }
  }
  if (read.tracks[0].samples.empty()) return fail(file, "has no line of values");
  return read;
}

}  // namespace sigs
