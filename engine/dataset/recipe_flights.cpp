// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <filesystem>
#include <string>
#include <vector>

#include "base/text.h"
#include "dataset/recipe_reading.h"
#include "encounter_model/model_flight.h"

namespace sigs {

namespace {

std::string kinds() {
  std::vector<std::string> names;
  for (const FlightKind kind : all_flight_kinds()) names.emplace_back(name_of(kind));
  return listed(names);
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
    node.log().wrong(node.key_of("kind"), fmt::format("is \"{}\"; there are {}", kind_name, kinds()));
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
  read_source(node, flight);
  node.done();
  return flight;
}

}  // namespace

std::optional<Quantity> read_quantity(RecipeNode& node, std::string_view name) {
  const Json* const json = node.value(name);
  if (json == nullptr) return std::nullopt;
  const tl::expected<Quantity, std::string> quantity = quantity_of(*json);
  if (quantity) return *quantity;
  node.log().wrong(node.key_of(name), quantity.error());
  return std::nullopt;
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
