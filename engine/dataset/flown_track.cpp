// SPDX-License-Identifier: MIT
#include "dataset/flown_track.h"

#include <algorithm>
#include <utility>

#include "base/interpolation.h"
#include "encounter/daa_file.h"
#include "geo/geodetic.h"
#include "geo/recorded_path.h"
#include "telemetry/track.h"

namespace sigs {

namespace {

constexpr int kSmoothingSteps = 32;  // places that a mean is made of

// Adds a point; one that is not later than the last is left out.
void add_point(FlownTrack& track, double time_s, const glm::dvec3& place_ned_m) {
  if (!track.times_s.empty() && !(time_s > track.times_s.back())) return;
  track.times_s.push_back(time_s);
  track.places_ned_m.push_back(place_ned_m);
}

// Keeps a track of at least two points, with times from 0.
void keep(FlownTrack track, std::vector<FlownTrack>& tracks) {
  if (track.times_s.size() < 2) return;
  const double first_s = track.times_s.front();
  for (double& time_s : track.times_s) time_s -= first_s;
  tracks.push_back(std::move(track));
}

ReadFlights flights_of(const std::vector<RecordedPath>& paths) {
  ReadFlights read;
  for (const RecordedPath& path : paths) {
    read.warnings.insert(read.warnings.end(), path.warnings.begin(), path.warnings.end());
    if (!path.has_times) continue;
    const LocalFrame frame(path.points.front().place, 0);
    FlownTrack track{.name = path.name.empty() ? path.icao24 : path.name};
    for (const TimedPlace& point : path.points) add_point(track, point.time_s, frame.world_of(point.place));
    keep(std::move(track), read.tracks);
  }
  return read;
}

ReadFlights flights_of(const Track& log) {
  ReadFlights read{.tracks = {}, .warnings = log.warnings};
  FlownTrack track{.name = log.device};
  if (!log.position.empty()) {
    const LocalFrame frame(log.position.values.front(), 0);
    for (std::size_t i = 0; i < log.position.values.size(); ++i)
      add_point(track, log.position.times_s[i], frame.world_of(log.position.values[i]));
  } else {
    for (std::size_t i = 0; i < log.local_position_ned_m.values.size(); ++i)
      add_point(track, log.local_position_ned_m.times_s[i], log.local_position_ned_m.values[i]);
  }
  keep(std::move(track), read.tracks);
  return read;
}

ReadFlights flights_of(const EncounterFile& encounter) {
  ReadFlights read{.tracks = {}, .warnings = encounter.warnings};
  for (const SampledTrack& sampled : encounter.tracks) {
    FlownTrack track{.name = sampled.name};
    for (const TrackSample& sample : sampled.samples) add_point(track, sample.time_s, sample.state.position_m);
    keep(std::move(track), read.tracks);
  }
  return read;
}

}  // namespace

glm::dvec3 place_at(const FlownTrack& track, double time_s, double smoothing_s) {
  const double half_s = std::min({smoothing_s / 2, time_s - track.times_s.front(), track.times_s.back() - time_s});
  if (!(half_s > 0)) return value_at(track.times_s, track.places_ned_m, time_s);
  glm::dvec3 sum_m(0);
  for (int i = 0; i < kSmoothingSteps; ++i)
    sum_m += value_at(track.times_s, track.places_ned_m, time_s + half_s * ((2 * i + 1.0) / kSmoothingSteps - 1));
  return sum_m / double(kSmoothingSteps);
}

double max_gap_s(const FlownTrack& track, double from_s, double to_s) {
  double longest_s = 0;
  for (std::size_t i = 1; i < track.times_s.size(); ++i)
    if (track.times_s[i] > from_s && track.times_s[i - 1] < to_s)
      longest_s = std::max(longest_s, track.times_s[i] - track.times_s[i - 1]);
  return longest_s;
}

Result<ReadFlights> read_flown_tracks(const std::filesystem::path& file) {
  ReadFlights read;
  const Result<std::vector<RecordedPath>> paths = read_recorded_paths(file);
  if (!paths && paths.error().kind == ErrorKind::cannot_read) return fail(paths.error());
  if (paths) read = flights_of(*paths);
  if (read.tracks.empty())
    if (const Result<EncounterFile> encounter = read_encounter_file(file.string()); encounter)
      read = flights_of(*encounter);
  if (read.tracks.empty())
    if (const Result<Track> log = read_track(file); log) read = flights_of(*log);
  if (!read.tracks.empty()) return read;
  if (!paths) return fail(paths.error().where, paths.error().what + "; nor is it a flight log, .daa or CSV of pairs");
  return fail(file.string(), "has no flight with times: of each at least two points at different times are needed");
}

}  // namespace sigs
