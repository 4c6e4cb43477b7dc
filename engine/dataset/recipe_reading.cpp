// SPDX-License-Identifier: MIT
#include "dataset/recipe_reading.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <utility>

#include "base/text.h"
#include "encounter_model/model_flight.h"
#include "project/fields.h"

namespace sigs {

namespace {

const Json& no_object() {
  static const Json empty = Json::object();
  return empty;
}

std::string found(const Json& json) {
  return ", found " + shown(json);
}

}  // namespace

void RecipeLog::wrong(const std::string& key, const std::string& what, ErrorKind kind) {
  if (!error) error = Error{key.empty() ? file : file + ": " + key, what, kind};
}

void RecipeLog::warn(const std::string& key, const std::string& what) {
  warnings.push_back({file + ": " + key, what});
}

RecipeNode::RecipeNode(const Json& json, std::string key, RecipeLog& log)
    : json_(&json), key_(std::move(key)), log_(&log) {
  if (json.is_object()) return;
  log.wrong(key_, "expected { ... }" + found(json));
  json_ = &no_object();
}

std::string RecipeNode::key_of(std::string_view name) const {
  return key_.empty() ? std::string(name) : key_ + "." + std::string(name);
}

const Json* RecipeNode::value(std::string_view name) {
  known_.emplace(name);
  const auto place = json_->find(std::string(name));
  return place == json_->end() ? nullptr : &*place;
}

std::optional<std::string> RecipeNode::text(std::string_view name) {
  const Json* const json = value(name);
  if (json == nullptr) return std::nullopt;
  if (json->is_string()) return json->get<std::string>();
  log_->wrong(key_of(name), "expected a text in quotes" + found(*json));
  return std::nullopt;
}

std::string RecipeNode::needed_text(std::string_view name) {
  const std::string given = text(name).value_or("");
  if (given.empty()) log_->wrong(key_of(name), "is missing or empty; give it a text");
  return given;
}

std::optional<int> RecipeNode::whole(std::string_view name, int low, int high) {
  const Json* const json = value(name);
  if (json == nullptr) return std::nullopt;
  const double number = json->is_number() ? json->get<double>() : std::nan("");
  if (number == std::floor(number) && number >= low && number <= high) return static_cast<int>(number);
  log_->wrong(key_of(name), fmt::format("expected a whole number from {} to {}{}", low, high, found(*json)));
  return std::nullopt;
}

std::vector<std::string> RecipeNode::texts(std::string_view name) {
  const Json* const json = value(name);
  if (json == nullptr) return {};
  std::vector<std::string> list;
  if (json->is_array())
    for (const Json& item : *json)
      if (item.is_string()) list.push_back(item.get<std::string>());
  if (!json->is_array() || json->empty() || list.size() != json->size())
    log_->wrong(key_of(name), "expected a list of names [\"...\"]" + found(*json));
  return list;
}

std::map<std::string, std::string> RecipeNode::text_map(std::string_view name) {
  const Json* const json = value(name);
  std::map<std::string, std::string> texts;
  if (json == nullptr) return texts;
  if (!json->is_object()) log_->wrong(key_of(name), "expected { ... }" + found(*json));
  for (const auto& [key, item] : json->items())
    if (item.is_string())
      texts[key] = item.get<std::string>();
    else
      log_->wrong(key_of(name) + "." + key, "expected a text in quotes" + found(item));
  return texts;
}

std::filesystem::path from_recipe_folder(const RecipeNode& node, const std::string& name) {
  std::error_code code;
  return (std::filesystem::absolute(node.log().file, code).parent_path() / name).lexically_normal();
}

std::vector<RecipeNode> RecipeNode::nodes(std::string_view name) {
  const Json* const json = value(name);
  std::vector<RecipeNode> list;
  if (json == nullptr || !json->is_array() || json->empty()) {
    log_->wrong(key_of(name), "expected a list [{ ... }] of at least one" + (json ? found(*json) : ""));
    return list;
  }
  for (std::size_t i = 0; i < json->size(); ++i)
    list.emplace_back(json->at(i), fmt::format("{}[{}]", key_of(name), i), *log_);
  return list;
}

void RecipeNode::done() {
  const std::vector<std::string> known(known_.begin(), known_.end());
  for (const auto& [key, item] : json_->items())
    if (!known_.contains(key) && key != "about")
      log_->warn(key_of(key), "unknown key, not used" + suggestion(known, key));
}

namespace {

constexpr double kMaxNumber = 1e12;  // of any number that a recipe gives
constexpr double kMaxBoundDeviations =
    8;  // standard deviations from the mean beyond which the remaining probability is too small to sample
constexpr double kInfinite = std::numeric_limits<double>::infinity();

using Read = tl::expected<Quantity, std::string>;

std::optional<double> number_of(const Json& json) {
  if (!json.is_number()) return std::nullopt;
  const double number = json.get<double>();
  return std::abs(number) <= kMaxNumber ? std::optional(number) : std::nullopt;
}

Read uniform_of(const Json& json) {
  const bool is_pair = json.is_array() && json.size() == 2;
  const std::optional<double> low = is_pair ? number_of(json[0]) : std::nullopt;
  const std::optional<double> high = is_pair ? number_of(json[1]) : std::nullopt;
  if (!low || !high || *low > *high)
    return tl::unexpected("expected {\"uniform\": [low, high]} with low <= high, found " + shown(json));
  return Quantity{.kind = Quantity::Kind::uniform, .low = *low, .high = *high};
}

tl::expected<Quantity, std::string> log_uniform_of(const Json& json) {
  tl::expected<Quantity, std::string> quantity = uniform_of(json);
  if (!quantity) return quantity;
  if (!(quantity->low > 0)) return tl::unexpected("\"log_uniform\" needs limits above 0, found " + shown(json));
  quantity->kind = Quantity::Kind::log_uniform;
  return quantity;
}

Read choice_of(const Json& json) {
  Quantity quantity{.kind = Quantity::Kind::choice};
  if (json.is_array())
    for (const Json& item : json)
      if (const std::optional<double> number = number_of(item)) quantity.choices.push_back(*number);
  if (quantity.choices.empty() || quantity.choices.size() != json.size())
    return tl::unexpected("expected {\"choice\": [numbers]}, at least one, found " + shown(json));
  return quantity;
}

Read normal_of(const Json& json) {
  const std::string expected =
      "expected {\"normal\": {\"mean\": m, \"deviation\": d, \"low\": a, \"high\": b}}, found " + shown(json);
  if (!json.is_object()) return tl::unexpected(expected);
  Quantity normal{.kind = Quantity::Kind::normal, .low = -kInfinite, .high = kInfinite, .deviation = -1};
  bool has_mean = false;
  for (const auto& [key, item] : json.items()) {
    const std::optional<double> number = number_of(item);
    double* const place = key == "mean"        ? &normal.mean
                          : key == "deviation" ? &normal.deviation
                          : key == "low"       ? &normal.low
                          : key == "high"      ? &normal.high
                                               : nullptr;
    if (!number || place == nullptr) return tl::unexpected(expected);
    *place = *number;
    has_mean = has_mean || key == "mean";
  }
  if (!has_mean || normal.deviation < 0 || normal.low > normal.high) return tl::unexpected(expected);
  const double max_offset = kMaxBoundDeviations * normal.deviation;
  if (normal.low > normal.mean + max_offset || normal.high < normal.mean - max_offset)
    return tl::unexpected(
        std::string("the bounds lie more than 8 deviations from the mean; nothing is left to sample"));
  return normal;
}

}  // namespace

tl::expected<Quantity, std::string> quantity_of(const Json& json) {
  if (const std::optional<double> number = number_of(json))
    return Quantity{.kind = Quantity::Kind::fixed, .value = *number};
  if (json.is_object() && json.size() == 1) {
    const std::string& kind = json.begin().key();
    const Json& rest = json.begin().value();
    if (kind == "uniform") return uniform_of(rest);
    if (kind == "log_uniform") return log_uniform_of(rest);
    if (kind == "normal") return normal_of(rest);
    if (kind == "choice") return choice_of(rest);
  }
  return tl::unexpected(
      "expected a number up to 1e12, {\"uniform\": [low, high]}, {\"log_uniform\": [low, high]}, {\"normal\": {...}} "
      "or " +
      std::string("{\"choice\": [...]}, found ") + shown(json));
}

namespace {

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
