// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "base/result.h"
#include "encounter_model/encounter_model.h"

namespace sigs {

// Where flights come from that are not made of quantities alone: recordings, and statistics of recordings.

// A flight that something flew, as recorded.
struct FlownTrack {
  std::string name;                      // callsign, address or name in the file; may be empty
  std::vector<double> times_s;           // from the first point, which is at 0; rising strictly; at least two
  std::vector<glm::dvec3> places_ned_m;  // one for each time: north, east, down, from wherever the recording began

  [[nodiscard]] double length_s() const { return times_s.back(); }
};

// The place at a time: the mean over smoothing_s seconds, half of them before, of the straight lines between the
// points. Near the ends the mean is over fewer seconds, equally many before and after. Times beyond the ends count as
// the ends. smoothing_s >= 0; with 0 the lines themselves, whose direction jumps at points.
[[nodiscard]] glm::dvec3 place_at(const FlownTrack& track, double time_s, double smoothing_s);

// The longest time between two neighbouring points from one time to another, in seconds.
[[nodiscard]] double max_gap_s(const FlownTrack& track, double from_s, double to_s);

// All flights with times that a file has: whatever geo/recorded_path.h (GPX, KML, ADS-B), telemetry/track.h (logs
// of aircraft, CSV) or encounter/daa_file.h (.daa, CSV of pairs) reads, by the content. Heights are taken as they are.
// Errors: cannot_read; bad_data: none of these formats, or no flight of two points with times in it.
struct ReadFlights {
  std::vector<FlownTrack> tracks;
  std::vector<Warning> warnings;
};
[[nodiscard]] Result<ReadFlights> read_flown_tracks(const std::filesystem::path& file);

// What a flight of a recipe is taken from.
struct FlightSource {
  std::optional<EncounterModel> model;      // of kind encounter_model
  std::optional<EncounterModel> own_model;  // likewise; none: the ownship flies as the camera does
  std::vector<FlownTrack> tracks;           // of kind recorded; one of them is sampled
};

}  // namespace sigs
