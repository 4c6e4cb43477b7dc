// SPDX-License-Identifier: MIT
#include "encounter/daa_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "base/input_file.h"
#include "base/text.h"
#include "encounter/well_clear.h"

namespace sigs {

namespace {

constexpr double kMaxPlace_m = 1e9;    // beyond the Moon
constexpr double kMaxSpeed_mps = 1e6;  // beyond any vehicle
constexpr double kMaxTime_s = 1e12;

// --- Columns.

enum class Quantity { name, east, north, up, latitude, longitude, v_east, v_north, v_up, course, speed, time };

struct KnownColumn {
  std::string_view name;
  Quantity quantity;
  std::string_view unit;  // where the file states none
};

constexpr auto kKnown = std::to_array<KnownColumn>({
    {"name", Quantity::name, "none"},
    {"aircraft", Quantity::name, "none"},
    {"id", Quantity::name, "none"},
    {"sx", Quantity::east, "nmi"},
    {"sy", Quantity::north, "nmi"},
    {"sz", Quantity::up, "ft"},
    {"east", Quantity::east, "nmi"},
    {"north", Quantity::north, "nmi"},
    {"alt", Quantity::up, "ft"},
    {"altitude", Quantity::up, "ft"},
    {"lat", Quantity::latitude, "deg"},
    {"latitude", Quantity::latitude, "deg"},
    {"lon", Quantity::longitude, "deg"},
    {"long", Quantity::longitude, "deg"},
    {"longitude", Quantity::longitude, "deg"},
    {"vx", Quantity::v_east, "knot"},
    {"vy", Quantity::v_north, "knot"},
    {"vz", Quantity::v_up, "fpm"},
    {"trk", Quantity::course, "deg"},
    {"track", Quantity::course, "deg"},
    {"gs", Quantity::speed, "knot"},
    {"groundspeed", Quantity::speed, "knot"},
    {"vs", Quantity::v_up, "fpm"},
    {"verticalspeed", Quantity::v_up, "fpm"},
    {"hdot", Quantity::v_up, "fpm"},
    {"time", Quantity::time, "s"},
    {"clock", Quantity::time, "s"},
    {"tm", Quantity::time, "s"},
    {"st", Quantity::time, "s"},
});

struct DaaColumn {
  std::string name;
  std::size_t index = 0;
  FileUnit unit;
};

struct Header {
  std::map<Quantity, DaaColumn> columns;
  std::size_t count = 0;  // of values in a line
};

Result<Header> header_of(std::string_view line, int number, EncounterFile& read, const std::string& file) {
  Header header;
  for (const std::string_view name : file_values(line)) {
    const std::size_t index = header.count++;
    const auto* const known = std::find_if(kKnown.begin(), kKnown.end(),
                                           [&](const KnownColumn& column) { return column.name == lower_case(name); });
    if (known == kKnown.end()) {
      read.warnings.push_back({file_place(file, number, name), "is not read"});
      continue;
    }
    if (!header.columns.emplace(known->quantity, DaaColumn{std::string(name), index, *file_unit(known->unit)}).second)
      return fail(file_place(file, number, name), "is a second column of the same quantity");
  }
  return header;
}

Result<void> check_complete(const Header& header, int number, const std::string& file) {
  const auto has = [&](std::initializer_list<Quantity> all) {
    return std::all_of(all.begin(), all.end(), [&](Quantity one) { return header.columns.contains(one); });
  };
  const std::string where = file_place(file, number, "");
  if (!has({Quantity::name}) || !has({Quantity::time}))
    return fail(where, "needs the columns name and time; is it a DAIDALUS file?");
  if (!has({Quantity::up}) || has({Quantity::east, Quantity::north}) == has({Quantity::latitude, Quantity::longitude}))
    return fail(where, "needs the columns sx, sy, sz or lat, lon, alt for the place");
  if (!has({Quantity::v_up}) || has({Quantity::v_east, Quantity::v_north}) == has({Quantity::course, Quantity::speed}))
    return fail(where, "needs the columns vx, vy, vz or trk, gs, vs for the velocity");
  return {};
}

Result<void> take_units(Header& header, const std::vector<std::string_view>& values, int number,
                        const std::string& file) {
  if (values.size() != header.count)
    return fail(file_place(file, number, ""),
                fmt::format("has {}, the line of names has {}", count_text(std::ssize(values), "unit"), header.count));
  for (auto& [quantity, column] : header.columns) {
    const std::string_view text = values[column.index];
    const std::optional<FileUnit> unit = file_unit(text);
    if (!unit || unit->kind != column.unit.kind)
      return fail(file_place(file, number, column.name),
                  fmt::format("\"{}\" is no unit for it that is known", shown_value(text)));
    column.unit = *unit;
  }
  return {};
}

// --- Lines.

// A line in metres, radians and seconds; latitude and longitude in degrees, as they are kept.
struct Line {
  std::string name;
  std::map<Quantity, double> numbers;
};

Result<Line> line_of(const std::vector<std::string_view>& values, const Header& header, int number,
                     const std::string& file) {
  if (values.size() != header.count)
    return fail(file_place(file, number, ""),
                fmt::format("has {}, {} are expected", count_text(std::ssize(values), "value"), header.count));
  Line line;
  for (const auto& [quantity, column] : header.columns) {
    const std::string_view text = values[column.index];
    const std::string where = file_place(file, number, column.name);
    if (quantity == Quantity::name) {
      if (text.empty()) return fail(where, "is empty; each line needs the name of its aircraft");
      line.name = text;
      continue;
    }
    const std::optional<double> value = quantity == Quantity::time ? file_time_s(text) : finite_number(text);
    if (!value) return fail(where, fmt::format("\"{}\" is no finite number", shown_value(text)));
    const bool is_place_on_earth = quantity == Quantity::latitude || quantity == Quantity::longitude;
    const double scaled = *value * column.unit.factor / (is_place_on_earth ? kDegree_rad : 1);
    const UnitKind kind = column.unit.kind;
    const double limit = quantity == Quantity::latitude    ? 90
                         : quantity == Quantity::longitude ? 360
                         : kind == UnitKind::time          ? kMaxTime_s
                         : kind == UnitKind::length        ? kMaxPlace_m
                         : kind == UnitKind::speed         ? kMaxSpeed_mps
                                                           : 1e6;
    // Degrees may have gained a rounding on their way.
    if (std::abs(scaled) > limit * (1 + 1e-12))
      return fail(where, fmt::format("{} is beyond what it can be", shown_value(text)));
    line.numbers[quantity] = quantity == Quantity::latitude ? std::clamp(scaled, -90.0, 90.0) : scaled;
  }
  return line;
}

glm::dvec3 ned_velocity(const Line& line) {
  const auto& numbers = line.numbers;
  if (numbers.contains(Quantity::v_east))
    return {numbers.at(Quantity::v_north), numbers.at(Quantity::v_east), -numbers.at(Quantity::v_up)};
  const double speed = numbers.at(Quantity::speed);
  const double course = numbers.at(Quantity::course);
  return {speed * std::cos(course), speed * std::sin(course), -numbers.at(Quantity::v_up)};
}

// The plane for files with places on the Earth.
class Plane {
 public:
  explicit Plane(const GeodeticPosition& origin) : frame_(origin, 0), height_m_(origin.height_m) {}

  [[nodiscard]] AircraftState state_of(const Line& line) const {
    const double latitude_deg = line.numbers.at(Quantity::latitude);
    const double longitude_deg = std::remainder(line.numbers.at(Quantity::longitude), 360);
    const double up_m = line.numbers.at(Quantity::up);
    const glm::dvec3 here = frame_.world_of({latitude_deg, longitude_deg, height_m_});
    const glm::dvec3 velocity = ned_velocity(line);
    // North at the place, in the plane: towards a place some metres nearer to the equator, reversed where that is
    // south, so that no pole is crossed.
    const double step_deg = latitude_deg > 0 ? -1e-4 : 1e-4;
    const glm::dvec3 there = frame_.world_of({latitude_deg + step_deg, longitude_deg, height_m_});
    glm::dvec2 north = glm::dvec2(there - here) / step_deg;
    north /= std::hypot(north.x, north.y);
    const glm::dvec2 east(-north.y, north.x);
    const glm::dvec2 flat = velocity.x * north + velocity.y * east;
    return {{here.x, here.y, -up_m}, {flat.x, flat.y, velocity.z}};
  }

 private:
  LocalFrame frame_;
  double height_m_;
};

AircraftState flat_state_of(const Line& line) {
  return {{line.numbers.at(Quantity::north), line.numbers.at(Quantity::east), -line.numbers.at(Quantity::up)},
          ned_velocity(line)};
}

// Puts the lines' states to their aircraft.
class Aircraft {
 public:
  Aircraft(EncounterFile& read, const Header& header, const std::string& file)
      : read_(read), header_(header), file_(file) {}

  Result<void> add(const Line& line, int number) {
    if (line.numbers.contains(Quantity::latitude) && !plane_) {
      read_.origin = {line.numbers.at(Quantity::latitude), std::remainder(line.numbers.at(Quantity::longitude), 360),
                      line.numbers.at(Quantity::up)};
      if (const Result<void> place = check_place(*read_.origin); !place)
        return fail(file_place(file_, number, header_.columns.at(Quantity::up).name), place.error().what);
      plane_.emplace(*read_.origin);
    }
    const auto [found, is_new] = index_.emplace(line.name, read_.tracks.size());
    if (is_new) read_.tracks.push_back({.name = line.name, .has_velocities = true});
    SampledTrack& track = read_.tracks[found->second];
    const double time_s = line.numbers.at(Quantity::time);
    if (!track.samples.empty() && time_s <= track.samples.back().time_s)
      return fail(file_place(file_, number, header_.columns.at(Quantity::time).name),
                  fmt::format("{} s is not after {} s, the time of the line of {} before it", exact_text(time_s),
                              exact_text(track.samples.back().time_s), shown_value(line.name)));
    track.samples.push_back({time_s, plane_ ? plane_->state_of(line) : flat_state_of(line)});
    return {};
  }

 private:
  EncounterFile& read_;
  const Header& header_;
  const std::string& file_;
  std::map<std::string, std::size_t, std::less<>> index_;
  std::optional<Plane> plane_;
};

// The next line that says something; none at the end.
std::optional<std::string_view> next_spoken_line(std::string_view& text, int& number) {
  while (!text.empty()) {
    ++number;
    std::string_view line = next_line(text);
    line = trimmed(line.substr(0, line.find('#')));
    if (!line.empty()) return line;
  }
  return {};
}

}  // namespace

Result<EncounterFile> parse_daa(std::string_view text, const std::string& file) {
  EncounterFile read;
  text = without_bom(text);
  int number = 0;
  const std::optional<std::string_view> first = next_spoken_line(text, number);
  if (!first) return fail(file, "is empty; a line of names and lines of values are expected");
  Result<Header> header = header_of(*first, number, read, file);
  if (!header) return fail(header.error());
  if (const Result<void> complete = check_complete(*header, number, file); !complete) return fail(complete.error());
  Aircraft aircraft(read, *header, file);
  const std::size_t time_index = header->columns.at(Quantity::time).index;
  bool may_be_units = true;
  for (auto line = next_spoken_line(text, number); line; line = next_spoken_line(text, number)) {
    const std::vector<std::string_view> values = file_values(*line);
    // A line has units in place of values where no number stands under the time.
    if (std::exchange(may_be_units, false) && time_index < values.size() && !file_time_s(values[time_index])) {
      if (const Result<void> taken = take_units(*header, values, number, file); !taken) return fail(taken.error());
      continue;
    }
    const Result<Line> state = line_of(values, *header, number, file);
    if (!state) return fail(state.error());
    if (const Result<void> added = aircraft.add(*state, number); !added) return fail(added.error());
  }
  if (read.tracks.size() < 2)
    return fail(file, fmt::format("has {}; an ownship and an intruder are needed",
                                  count_text(std::ssize(read.tracks), "aircraft")));
  return read;
}

Result<EncounterFile> read_encounter_file(const std::string& file) {
  const Result<std::string> text = read_text(file);
  if (!text) return fail(text.error());
  std::string_view rest = without_bom(*text);
  int number = 0;
  const std::string first = lower_case(next_spoken_line(rest, number).value_or(""));
  const bool is_pair = first.find("own_") != std::string::npos || first.find("int_") != std::string::npos;
  return is_pair ? parse_pair_csv(*text, file) : parse_daa(*text, file);
}

std::string daa_text(std::span<const SampledTrack> tracks) {
  struct Place {
    double time_s;
    std::size_t track;
    AircraftState state;
  };
  std::vector<Place> all;
  for (std::size_t i = 0; i < tracks.size(); ++i) {
    const EncounterTrack track = track_of(tracks[i]);
    for (const TrackSample& sample : tracks[i].samples) all.push_back({sample.time_s, i, track.at(sample.time_s)});
  }
  std::stable_sort(all.begin(), all.end(), [](const Place& a, const Place& b) { return a.time_s < b.time_s; });
  std::string text =
      "NAME, sx, sy, sz, vx, vy, vz, time\n"
      "[none], [m], [m], [m], [m/s], [m/s], [m/s], [s]\n";
  for (const Place& place : all) {
    std::string name = tracks[place.track].name;
    std::replace_if(
        name.begin(), name.end(), [](char c) { return c == ',' || c == ';' || c == '#' || (c >= 0 && c <= ' '); }, '_');
    const glm::dvec3& p = place.state.position_m;
    const glm::dvec3& v = place.state.velocity_mps;
    text += name.empty() ? fmt::format("aircraft_{}", place.track) : name;
    for (const double number : {p.y, p.x, 0 - p.z, v.y, v.x, 0 - v.z, place.time_s})
      text.append(", ").append(exact_text(number));
    text += '\n';
  }
  return text;
}

}  // namespace sigs
