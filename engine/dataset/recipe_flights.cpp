// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/text.h"
#include "dataset/recipe.h"
#include "dataset/recipe_reading.h"
#include "encounter/daa_file.h"
#include "encounter_model/model_flight.h"
#include "geo/geodetic.h"
#include "geo/recorded_path.h"
#include "telemetry/track.h"

namespace sigs {

namespace {

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

// Any two of the three, or one of the first two alone.
void check_timing(const FlightPlan& flight, RecipeNode& node) {
  const bool speed = flight.quantities.contains("closing_speed_mps");
  const bool range = flight.quantities.contains("range_m");
  const bool time = flight.quantities.contains("time_of_closest_approach_s");
  if (!speed && !range) node.log().wrong(node.key_of("closing_speed_mps"), "is missing; give it or range_m");
  if (speed && range && time)
    node.log().wrong(node.key_of("range_m"),
                     "follows from closing_speed_mps and time_of_closest_approach_s; give two of the three");
}

// One way to say how large it is, and one where it moves.
void check_position(const FlightPlan& flight, RecipeNode& node) {
  const auto has = [&](const char* quantity) { return flight.quantities.contains(quantity); };
  if (has("size_px") == has("distance_m"))
    node.log().wrong(node.key_of("size_px"), has("size_px") ? "stands beside distance_m; give one of the two"
                                                            : "is missing; give it or distance_m");
  if (has("course_deg") && (has("direction_deg") || has("approach_angle_deg")))
    node.log().wrong(node.key_of("course_deg"), "stands beside direction_deg or approach_angle_deg; give one way");
  if (has("climb_deg") && !has("course_deg")) node.log().wrong(node.key_of("climb_deg"), "needs course_deg");
}

// A file named by a flight, from the recipe's folder. None: not given.
std::optional<std::filesystem::path> file_of(RecipeNode& node, const char* key) {
  const std::optional<std::string> name = node.text(key);
  if (!name || name->empty()) return std::nullopt;
  return from_recipe_folder(node, *name);
}

std::optional<EncounterModel> read_model(RecipeNode& node, const char* key) {
  const std::optional<std::filesystem::path> file = file_of(node, key);
  if (!file) return std::nullopt;
  Result<EncounterModel> model = read_encounter_model(*file);
  const Result<void> flies = model ? check_can_fly(*model) : Result<void>();
  if (model && flies) {
    for (const Warning& warning : model->warnings) node.log().warn(node.key_of(key), warning.text());
    return *std::move(model);
  }
  const Error& error = model ? flies.error() : model.error();
  node.log().wrong(node.key_of(key), model ? file->string() + ": " + error.text() : error.text(), error.kind);
  return std::nullopt;
}

std::vector<FlownTrack> read_tracks(RecipeNode& node) {
  const std::optional<std::filesystem::path> file = file_of(node, "file");
  const std::optional<std::string> wanted = node.text("path");
  if (!file) return {};
  Result<ReadFlights> read = read_flown_tracks(*file);
  if (!read) {
    node.log().wrong(node.key_of("file"), read.error().text(), read.error().kind);
    return {};
  }
  for (const Warning& warning : read->warnings) node.log().warn(node.key_of("file"), warning.text());
  if (!wanted) return std::move(read->tracks);
  std::vector<std::string> names;
  std::vector<FlownTrack> chosen;
  for (FlownTrack& track : read->tracks) {
    if (names.size() < 10) names.push_back("\"" + track.name + "\"");
    if (lower_case(track.name) == lower_case(*wanted)) chosen.push_back(std::move(track));
  }
  if (chosen.empty())
    node.log().wrong(node.key_of("path"), fmt::format("no such flight: \"{}\"; there are {}", *wanted, listed(names)));
  return chosen;
}

void read_source(RecipeNode& node, FlightPlan& flight) {
  if (flight.kind != FlightKind::encounter_model && flight.kind != FlightKind::recorded) return;
  if (node.value("file") == nullptr)
    node.log().wrong(node.key_of("file"), flight.kind == FlightKind::recorded
                                              ? "is missing: the recording"
                                              : "is missing: the encounter model's text file");
  if (flight.kind == FlightKind::recorded) {
    flight.source.tracks = read_tracks(node);
    return;
  }
  flight.source.model = read_model(node, "file");
  flight.source.own_model = read_model(node, "own_file");
}

FlightPlan read_flight(RecipeNode node) {
  FlightPlan flight;
  const std::string kind_name = node.needed_text("kind");
  const std::optional<FlightKind> kind = flight_kind_of(kind_name);
  if (!kind) {
    node.log().wrong(node.key_of("kind"), fmt::format("is \"{}\"; there are {}", kind_name, flight_kind_names()));
    return flight;
  }
  flight.kind = *kind;
  flight.name = node.text("name").value_or(kind_name);
  for (const FlightQuantity& quantity : quantities_of(*kind)) {
    const std::optional<Quantity> given = read_quantity(node, quantity.name);
    if (given) flight.quantities[std::string(quantity.name)] = *given;
    if (!given && quantity.required)
      node.log().wrong(node.key_of(quantity.name), "is missing: " + std::string(quantity.help));
  }
  if (*kind == FlightKind::encounter) check_timing(flight, node);
  if (*kind == FlightKind::image_position) check_position(flight, node);
  read_source(node, flight);
  node.done();
  return flight;
}

}  // namespace

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

std::vector<FlightPlan> read_flights(const Json* list, const std::string& key, RecipeLog& log) {
  std::vector<FlightPlan> flights;
  if (list == nullptr || !list->is_array() || list->empty()) {
    log.wrong(key, "expected a list of at least one flight");
    return flights;
  }
  for (std::size_t i = 0; i < list->size(); ++i) {
    const Json& item = list->at(i);
    const Json named{{"kind", item}};
    flights.push_back(read_flight(RecipeNode(item.is_string() ? named : item, fmt::format("{}[{}]", key, i), log)));
  }
  return flights;
}

}  // namespace sigs
