// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <unordered_map>
#include <utility>

#include "base/csv.h"
#include "base/text.h"
#include "geo/recorded/formats.h"

namespace sigs {

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
  std::unordered_map<std::string, std::size_t> index;
  std::vector<PathDraft> drafts;
  while (!text.empty()) {
    const CsvFields fields = csv_fields(next_line(text));
    const std::string address = lower_case(file_name_text(field_at(fields, columns.address)));
    const std::string_view latitude = field_at(fields, columns.latitude);
    if (address.empty() || latitude.empty() || lower_case(latitude) == "null") continue;  // no position yet
    const auto [found, is_first] = index.try_emplace(address, drafts.size());
    if (is_first) {
      drafts.emplace_back();
      drafts.back().icao24 = address;
      drafts.back().height = HeightReference::ellipsoid;
    }
    PathDraft& draft = drafts[found->second];
    if (draft.name.empty()) draft.name = file_name_text(csv_text(field_at(fields, columns.callsign)));
    const DraftPoint point = point_of_state(fields, columns);
    if (!is_repeated(draft, point)) draft.points.push_back(point);
  }
  for (PathDraft& draft : drafts)
    if (draft.name.empty()) draft.name = draft.icao24;
  return drafts;
}

}  // namespace sigs
