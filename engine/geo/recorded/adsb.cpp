// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <unordered_map>
#include <utility>

#include "base/input_file.h"
#include "base/text.h"
#include "geo/recorded/path_draft.h"

namespace sigs {

// readsb: https://github.com/wiedehopf/readsb/blob/dev/README-json.md (aircraft.json, traces).
// OpenSky Network: https://openskynetwork.github.io/opensky-api/rest.html (states, tracks).

namespace {

using AdsbJson = nlohmann::json;

constexpr double kMetresOfFoot = 0.3048;

// The member of an object, the element of a list; null where there is none or `json` is something else.
const AdsbJson& member(const AdsbJson& json, const char* key) {
  static const AdsbJson kNone;
  if (!json.is_object()) return kNone;
  const auto found = json.find(key);
  return found == json.end() ? kNone : *found;
}

const AdsbJson& element(const AdsbJson& json, std::size_t index) {
  static const AdsbJson kNone;
  return json.is_array() && index < json.size() ? json[index] : kNone;
}

std::optional<double> adsb_number(const AdsbJson& json, double unit = 1) {
  if (!json.is_number()) return std::nullopt;
  return json.get<double>() * unit;
}

double adsb_number_or_nan(const AdsbJson& json) {
  return adsb_number(json).value_or(std::numeric_limits<double>::quiet_NaN());
}

std::string adsb_name(const AdsbJson& json) {
  return json.is_string() ? file_name_text(json.get_ref<const std::string&>()) : std::string();
}

// The drafts of all aircraft, by their addresses, in the order of their first appearance.
class Aircraft {
 public:
  // The draft of an address, to which points are added. A callsign names the path.
  PathDraft& of(const std::string& address, const std::string& callsign) {
    const auto [found, is_first] = index_.try_emplace(lower_case(address), drafts_.size());
    if (is_first) {
      drafts_.emplace_back();
      drafts_.back().icao24 = found->first;
      drafts_.back().height = HeightReference::ellipsoid;
    }
    PathDraft& draft = drafts_[found->second];
    if (draft.name.empty()) draft.name = callsign;
    return draft;
  }

  // Unless it surely is the same message as the point before, repeated in a later snapshot: at the same place, at a
  // time that differs by less than rounding makes it.
  void add(PathDraft& draft, const DraftPoint& point) {
    constexpr double kRounding_s = 0.5;  // readsb rounds the age of a position to 0.1 s
    const DraftPoint* const last = draft.points.empty() ? nullptr : &draft.points.back();
    if (last && last->latitude_deg == point.latitude_deg && last->longitude_deg == point.longitude_deg &&
        last->time_s && point.time_s && std::abs(*last->time_s - *point.time_s) < kRounding_s)
      return;
    draft.points.push_back(point);
  }

  [[nodiscard]] std::vector<PathDraft> take() {
    for (PathDraft& draft : drafts_)
      if (draft.name.empty()) draft.name = draft.icao24;
    return std::move(drafts_);
  }

 private:
  std::unordered_map<std::string, std::size_t> index_;
  std::vector<PathDraft> drafts_;
};

// An entry of aircraft.json. Without a place it is no point.
void add_readsb_aircraft(const AdsbJson& entry, std::optional<double> now_s, Aircraft& aircraft) {
  const std::string address = adsb_name(member(entry, "hex"));
  const AdsbJson& latitude = member(entry, "lat");
  if (address.empty() || latitude.is_null()) return;
  DraftPoint point;
  point.latitude_deg = adsb_number_or_nan(latitude);
  point.longitude_deg = adsb_number_or_nan(member(entry, "lon"));
  point.height_m = adsb_number(member(entry, "alt_geom"), kMetresOfFoot);
  point.pressure_height_m = adsb_number(member(entry, "alt_baro"), kMetresOfFoot);
  if (now_s) point.time_s = *now_s - adsb_number(member(entry, "seen_pos")).value_or(0);
  aircraft.add(aircraft.of(address, adsb_name(member(entry, "flight"))), point);
}

// Services that answer in this format count milliseconds.
std::optional<double> now_of(const AdsbJson& json) {
  constexpr double kLaterThanAnySecond = 1e11;  // the year 5138 in seconds, 1973 in milliseconds
  const std::optional<double> now = adsb_number(member(json, "now"));
  return now && *now > kLaterThanAnySecond ? *now / 1000 : now;
}

void add_readsb_trace(const AdsbJson& json, Aircraft& aircraft) {
  constexpr unsigned kIsGeometric = 8;  // flag: the altitude of the row is not the pressure's
  const std::optional<double> start_s = adsb_number(member(json, "timestamp"));
  PathDraft& draft = aircraft.of(adsb_name(member(json, "icao")), "");
  if (!start_s) draft.utc = false;
  for (const AdsbJson& row : member(json, "trace")) {
    DraftPoint point;
    if (const std::optional<double> after_s = adsb_number(element(row, 0)))
      point.time_s = start_s.value_or(0) + *after_s;
    point.latitude_deg = adsb_number_or_nan(element(row, 1));
    point.longitude_deg = adsb_number_or_nan(element(row, 2));
    const AdsbJson& flags = element(row, 6);
    const bool is_geometric = flags.is_number_unsigned() && (flags.get<std::uint64_t>() & kIsGeometric) != 0;
    (is_geometric ? point.height_m : point.pressure_height_m) = adsb_number(element(row, 3), kMetresOfFoot);
    const AdsbJson& details = element(row, 8);
    if (const auto height = adsb_number(member(details, "alt_geom"), kMetresOfFoot)) point.height_m = height;
    if (const auto height = adsb_number(element(row, 10), kMetresOfFoot)) point.height_m = height;
    if (draft.name.empty()) draft.name = adsb_name(member(details, "flight"));
    aircraft.add(draft, point);
  }
}

// A state without a place is no point.
void add_opensky_states(const AdsbJson& json, Aircraft& aircraft) {
  for (const AdsbJson& state : member(json, "states")) {
    const std::string address = adsb_name(element(state, 0));
    if (address.empty() || element(state, 6).is_null()) continue;
    DraftPoint point;
    point.time_s = adsb_number(element(state, 3));
    point.longitude_deg = adsb_number_or_nan(element(state, 5));
    point.latitude_deg = adsb_number_or_nan(element(state, 6));
    point.pressure_height_m = adsb_number(element(state, 7));
    point.height_m = adsb_number(element(state, 13));
    aircraft.add(aircraft.of(address, adsb_name(element(state, 1))), point);
  }
}

void add_opensky_track(const AdsbJson& json, Aircraft& aircraft) {
  PathDraft& draft = aircraft.of(adsb_name(member(json, "icao24")), adsb_name(member(json, "callsign")));
  for (const AdsbJson& row : member(json, "path")) {
    DraftPoint point;
    point.time_s = adsb_number(element(row, 0));
    point.latitude_deg = adsb_number_or_nan(element(row, 1));
    point.longitude_deg = adsb_number_or_nan(element(row, 2));
    point.pressure_height_m = adsb_number(element(row, 3));
    aircraft.add(draft, point);
  }
}

// Whether the value is of a known kind.
bool add_adsb_value(const AdsbJson& json, Aircraft& aircraft) {
  if (member(json, "trace").is_array()) {
    add_readsb_trace(json, aircraft);
  } else if (member(json, "path").is_array()) {
    add_opensky_track(json, aircraft);
  } else if (json.is_object() && json.contains("states")) {  // null where there are none
    add_opensky_states(json, aircraft);
  } else if (member(json, "hex").is_string()) {
    add_readsb_aircraft(json, now_of(json), aircraft);
  } else {
    for (const char* const key : {"aircraft", "ac"}) {
      const AdsbJson& entries = member(json, key);
      if (!entries.is_array()) continue;
      for (const AdsbJson& entry : entries) add_readsb_aircraft(entry, now_of(json), aircraft);
      return true;
    }
    return false;
  }
  return true;
}

// The same for a list of values.
bool add_adsb_values(const AdsbJson& json, Aircraft& aircraft) {
  if (!json.is_array()) return add_adsb_value(json, aircraft);
  bool is_known = false;
  for (const AdsbJson& value : json) is_known |= add_adsb_value(value, aircraft);
  return is_known;
}

// A discarded value where the text is no JSON.
AdsbJson parsed_adsb(std::string_view text) {
  return AdsbJson::parse(text.begin(), text.end(), nullptr, false);
}

// Whether a line has a value of a known kind. nullopt: the first line that has anything is no JSON value of its own.
std::optional<bool> add_adsb_lines(std::string_view text, Aircraft& aircraft, std::vector<std::string>& notes) {
  std::int64_t broken = 0;
  int number = 0;
  int first_broken = 0;
  bool is_known = false;
  bool has_value = false;
  while (!text.empty()) {
    const std::string_view line = trimmed(next_line(text));
    ++number;
    if (line.empty()) continue;
    const AdsbJson json = parsed_adsb(line);
    if (!has_value && json.is_discarded()) return std::nullopt;
    has_value = true;
    if (json.is_discarded()) {
      if (broken++ == 0) first_broken = number;
    } else {
      is_known |= add_adsb_values(json, aircraft);
    }
  }
  if (broken > 0)
    notes.push_back(
        fmt::format("{} left out, not JSON; the first is line {}", count_text(broken, "line"), first_broken));
  return is_known;
}

// The position and reason why a text is no JSON.
Error adsb_json_error(std::string_view text, const std::string& where) {
  try {
    const AdsbJson ignored = AdsbJson::parse(text.begin(), text.end());
  } catch (const AdsbJson::parse_error& error) {
    return {where + ": " + text_position(text, error.byte), "is not JSON from here on"};
  } catch (const AdsbJson::exception&) {
    return {where, "has a number that is too large"};
  }
  return {where, "is not JSON"};
}

}  // namespace

Result<std::vector<PathDraft>> drafts_of_adsb_json(std::string_view text, const std::string& where) {
  if (json_depth(text) > kMaxNesting)
    return fail(where, fmt::format("has brackets more than {} deep within one another", kMaxNesting));
  Aircraft aircraft;
  std::vector<std::string> notes;
  bool is_known = false;
  if (const AdsbJson json = parsed_adsb(text); !json.is_discarded()) {
    is_known = add_adsb_values(json, aircraft);
  } else {
    const std::optional<bool> lines = add_adsb_lines(text, aircraft, notes);
    if (!lines) return fail(adsb_json_error(text, where));
    is_known = *lines;
  }
  if (!is_known)
    return fail(
        where,
        "is JSON, but of no known kind: neither aircraft.json or a trace of readsb nor states or a track of the "
        "OpenSky Network");
  std::vector<PathDraft> drafts = aircraft.take();
  if (!drafts.empty()) drafts.front().notes.insert(drafts.front().notes.end(), notes.begin(), notes.end());
  return drafts;
}

// The table state_vectors_data4 of the OpenSky Network's database, and its samples
// (https://opensky-network.org/datasets/states): time, icao24, lat, lon, velocity, heading, vertrate, callsign,
// onground, alert, spi, squawk, baroaltitude, geoaltitude, lastposupdate, lastcontact. Metres and seconds of UTC.

namespace {

using CsvFields = std::vector<std::string_view>;

// The number of each column, whatever their order; nullopt: there is none of that name.
struct StateColumns {
  std::optional<std::size_t> time, address, latitude, longitude, callsign, pressure_height, height, position_time;
};

std::optional<std::size_t> column_named(const CsvFields& names, std::string_view name) {
  const auto found = std::find_if(names.begin(), names.end(),
                                  [name](std::string_view field) { return lower_case(trimmed(field)) == name; });
  if (found == names.end()) return std::nullopt;
  return static_cast<std::size_t>(found - names.begin());
}

StateColumns columns_of_states(std::string_view first_line) {
  const CsvFields names = csv_fields(first_line);
  return {.time = column_named(names, "time"),
          .address = column_named(names, "icao24"),
          .latitude = column_named(names, "lat"),
          .longitude = column_named(names, "lon"),
          .callsign = column_named(names, "callsign"),
          .pressure_height = column_named(names, "baroaltitude"),
          .height = column_named(names, "geoaltitude"),
          .position_time = column_named(names, "lastposupdate")};
}

bool has_needed(const StateColumns& columns) {
  return columns.address && columns.latitude && columns.longitude && (columns.time || columns.position_time);
}

std::string_view field_at(const CsvFields& fields, const std::optional<std::size_t>& column) {
  return column && *column < fields.size() ? fields[*column] : std::string_view();
}

// A state is repeated each second until the next position arrives, whose own time is better than that of the state.
DraftPoint point_of_state(const CsvFields& fields, const StateColumns& columns) {
  DraftPoint point;
  point.latitude_deg = file_number_or_nan(field_at(fields, columns.latitude));
  point.longitude_deg = file_number_or_nan(field_at(fields, columns.longitude));
  point.pressure_height_m = file_number_of(field_at(fields, columns.pressure_height));
  point.height_m = file_number_of(field_at(fields, columns.height));
  point.time_s = file_number_of(field_at(fields, columns.position_time));
  if (!point.time_s) point.time_s = file_number_of(field_at(fields, columns.time));
  return point;
}

}  // namespace

bool is_opensky_csv(std::string_view text) {
  return has_needed(columns_of_states(next_line(text)));
}

Result<std::vector<PathDraft>> drafts_of_opensky_csv(std::string_view text, const std::string& where) {
  const StateColumns columns = columns_of_states(next_line(text));
  if (!has_needed(columns)) return fail(where, "its first line has not the columns time, icao24, lat and lon");
  Aircraft aircraft;
  while (!text.empty()) {
    const CsvFields fields = csv_fields(next_line(text));
    const std::string address = file_name_text(field_at(fields, columns.address));
    const std::string_view latitude = field_at(fields, columns.latitude);
    if (address.empty() || latitude.empty() || lower_case(latitude) == "null") continue;  // no position yet
    PathDraft& draft = aircraft.of(address, file_name_text(csv_text(field_at(fields, columns.callsign))));
    aircraft.add(draft, point_of_state(fields, columns));
  }
  return aircraft.take();
}

}  // namespace sigs
