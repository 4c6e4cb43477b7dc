// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "encounter/encounter_track.h"
#include "geo/geodetic.h"

namespace sigs {

// Flights in one file.
struct EncounterFile {
  // The ownship first, then the intruders in the order in which the file names them.
  std::vector<SampledTrack> tracks;
  // The place of the world's origin, where the file has latitudes and longitudes: the ownship's first one.
  std::optional<GeodeticPosition> origin = {};
  std::vector<Warning> warnings = {};
};

// The encounter files of DAIDALUS (`.daa`; the pairing programs of MIT Lincoln Laboratory write the same as `.txt`):
// lines of values between commas or white space, `#` begins a comment.
//   first line   names of columns, in any order and case. The aircraft: name, aircraft, id. Place: sx sy sz (also east
//                north alt; sx is east, sz up), or lat lon alt. Velocity: vx vy vz, or trk gs vs (trk clockwise from
//                north). Time: time, clock, tm, st. Further columns are left out, with a warning
//   second line  may be left out: units, with brackets or without. Without: deg for lat, lon, trk; nmi for sx, sy;
//                ft for sz and alt; knot for vx, vy, gs; fpm for vz, vs; s
//   others       one aircraft at one time; times of an aircraft rise. The first aircraft is the ownship
// Latitudes and longitudes become the plane that touches WGS-84 at the ownship's first place, with heights kept as
// heights above it; velocities are turned by the meridians' convergence.
// Errors (bad_data) name line and column: an unknown unit or one of another kind, a missing column, a value that is no
// finite number, too few or too many values, a time that does not rise, a latitude beyond 90 degrees, fewer than two
// aircraft.
//   file  for messages
[[nodiscard]] Result<EncounterFile> parse_daa(std::string_view text, const std::string& file);

// The tracks as such a file: sx sy sz vx vy vz in m and m/s, ordered by time and then as given. Aircraft are written at
// their own samples; numbers read back as the same. Names are written without commas, white space and `#`.
// Reading it back needs velocities: where a track has none they are those of track_of().
[[nodiscard]] std::string daa_text(std::span<const SampledTrack> tracks);

// Any file of flights, by its content: parse_daa(), or parse_pair_csv() where the first column's name is of its kind.
// Errors also: cannot_read.
[[nodiscard]] Result<EncounterFile> read_encounter_file(const std::string& file);

// A table of two flights with one line for each time. First line: names with units. Time: `t_s`, `time_s`. For the
// ownship with `own_` before it and the intruder with `int_`: `east`, `north`, `alt` (or `up`) as places; `veast`,
// `vnorth`, `vup` as velocities, which may be left out for both; after it `_` and the unit: m, ft, nmi, km; mps, ftps,
// fps, kt, kts, fpm. Errors as those of parse_daa().
[[nodiscard]] Result<EncounterFile> parse_pair_csv(std::string_view text, const std::string& file);

// What the readers of both files share: units, and numbers with their line and column in errors.

enum class UnitKind { none, length, angle, speed, time };

// A unit as a factor to m, rad, m/s or s.
struct FileUnit {
  UnitKind kind = UnitKind::none;
  double factor = 1;
};

// "[ft]", "ft", "knot", "fpm", "ft/min", "ftps", "deg", "unitless" and so on, in any case; none for another word.
[[nodiscard]] std::optional<FileUnit> file_unit(std::string_view text);

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
