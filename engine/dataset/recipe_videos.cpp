// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "base/paths.h"
#include "base/text.h"
#include "dataset/recipe.h"
#include "dataset/recipe_reading.h"
#include "dataset/video_name.h"
#include "project/fields.h"

namespace sigs {

namespace {

// A field of a project's light and what its numbers are called among those sampled.
struct LightField {
  const char* key;
  std::vector<const char*> names;
};

const std::array<LightField, 3>& light_fields() {
  static const std::array<LightField, 3> fields{{{"position_m", {"light_x_m", "light_y_m", "light_z_m"}},
                                                 {"color", {"light_red", "light_green", "light_blue"}},
                                                 {"ambient", {"light_ambient"}}}};
  return fields;
}

// The range that a project allows in that field.
Span limits_of(const char* key) {
  Project project;
  for (const Field& field : fields_of(project))
    if (field.key == std::string("light.") + key) return {field.minimum, field.maximum};
  return {};
}

void read_number(const Json& json, const std::string& where, const LightField& field, std::size_t part,
                 LightPlan& light, RecipeLog& log) {
  const tl::expected<Quantity, std::string> quantity = quantity_of(json);
  if (!quantity) return log.wrong(where, quantity.error());
  const Span span = span_of(*quantity);
  const Span limits = limits_of(field.key);
  if (span.low < limits.low || span.high > limits.high)
    return log.wrong(where,
                     fmt::format("must lie between {} and {}; a normal quantity needs \"low\" and \"high\" for that",
                                 short_number_text(limits.low), short_number_text(limits.high)));
  light.quantities[field.names[part]] = *quantity;
}

void read_field(RecipeNode& node, const LightField& field, LightPlan& light) {
  const Json* const json = node.value(field.key);
  if (json == nullptr) return;
  const std::string where = node.key_of(field.key);
  if (field.names.size() == 1) return read_number(*json, where, field, 0, light, node.log());
  if (!json->is_array() || json->size() != field.names.size())
    return node.log().wrong(where, "expected a list of three quantities");
  for (std::size_t i = 0; i < json->size(); ++i)
    read_number(json->at(i), fmt::format("{}[{}]", where, i), field, i, light, node.log());
}

bool is_set(const std::vector<std::string>& settings, const char* key) {
  const std::string begin = std::string("light.") + key + "=";
  return std::any_of(settings.begin(), settings.end(), [&](const std::string& one) { return one.starts_with(begin); });
}

LightPlan read_light(RecipeNode node, const std::vector<std::string>& settings) {
  LightPlan light;
  for (const LightField& field : light_fields()) {
    read_field(node, field, light);
    if (is_set(settings, field.key))
      for (const char* const name : field.names) light.quantities.erase(name);
  }
  node.done();
  return light;
}

// A group's "light": { ... } or a list of them, each with "position_m", "color" (three quantities each) and "ambient"
// (one), all of them optional. What `settings` (KEY=VALUE given beside the recipe) set is left out, since it takes
// precedence. Values outside the limits of a project are mistakes.
std::vector<LightPlan> read_lights(RecipeNode& group, const std::vector<std::string>& settings) {
  const Json* const json = group.value("light");
  if (json == nullptr) return {};
  std::vector<LightPlan> lights;
  if (json->is_array())
    for (RecipeNode& node : group.nodes("light")) lights.push_back(read_light(std::move(node), settings));
  else
    lights.push_back(read_light(RecipeNode(*json, group.key_of("light"), group.log()), settings));
  return lights;
}

constexpr int kMaxVideos = 100'000;
constexpr int kMaxFrames = 1'000'000'000;
constexpr int kResamples = 100;  // of sampled groups without one
constexpr int kMaxResamples = 10'000;

// The flights of a sampled group without any. docs/dataset-recipe.md shows them.
constexpr const char* kRandomEncounter = R"([{"kind": "encounter",
  "miss_distance_m": {"uniform": [0, 150]}, "miss_angle_deg": {"uniform": [-180, 180]},
  "bearing_deg": {"uniform": [-45, 45]}, "elevation_deg": {"uniform": [-10, 10]},
  "closing_speed_mps": {"uniform": [40, 160]}}])";

template <class Named>
std::vector<std::string> names_of(const std::vector<Named>& all) {
  std::vector<std::string> names;
  for (const Named& one : all) names.push_back(one.name);
  return names;
}

bool has(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

// All aircraft that are no distractors; where there are none, all.
std::vector<std::string> intruders_of(const Recipe& recipe) {
  std::vector<std::string> names;
  for (const Aircraft& aircraft : recipe.aircraft)
    if (!aircraft.is_distractor) names.push_back(aircraft.name);
  return names.empty() ? names_of(recipe.aircraft) : names;
}

// The flights of a group; of a sampled one without any the standard encounter.
std::vector<FlightPlan> flights_in(RecipeNode& group, bool is_sampled) {
  static const Json random_encounter = Json::parse(kRandomEncounter);
  const Json* list = group.value("flights");
  if (list == nullptr && is_sampled) list = &random_encounter;
  return read_flights(list, group.key_of("flights"), group.log());
}

void check_split(const std::string& split, RecipeNode& group, const Recipe& recipe) {
  const std::vector<std::string> there = names_of(recipe.splits);
  if (const std::string wrong = file_name_error(split); !split.empty() && !wrong.empty())
    group.log().wrong(group.key_of("split"), wrong);
  if (!split.empty() && !there.empty() && !has(there, split))
    group.log().wrong(group.key_of("split"), fmt::format("no such split: \"{}\"; there are {}", split, listed(there)));
}

// How many videos, of each combination or in all.
void read_count(RecipeNode& node, VideoGroup& group) {
  const std::optional<int> videos = node.whole("videos", 1, kMaxVideos);
  const std::optional<int> count = node.whole("count", 1, kMaxVideos);
  group.is_sampled = node.value("videos") != nullptr;
  if (group.is_sampled && node.value("count") != nullptr)
    node.log().wrong(node.key_of("count"),
                     "counts each combination, videos samples so many in all; give one of the two");
  group.count = videos.value_or(count.value_or(1));
  group.resamples = node.whole("redraws", 0, kMaxResamples);
  if (group.is_sampled && !group.resamples) group.resamples = kResamples;
}

std::string standard_name(const VideoGroup& group) {
  if (group.is_sampled) return "video-{number}";
  return group.count > 1 ? "{background}-{aircraft}-{flight}-{number}" : "{background}-{aircraft}-{flight}";
}

// Samples belong to the video's name, so it cannot hold what is sampled.
void check_sampled_name(const VideoGroup& group, RecipeNode& node) {
  for (const char* const part : {"{background}", "{aircraft}", "{flight}"})
    if (group.name.find(part) != std::string::npos)
      node.log().wrong(node.key_of("name"),
                       std::string("has ") + part + ", which is sampled for each name; use {number} alone");
  if (group.count > 1 && group.name.find("{number}") == std::string::npos)
    node.log().wrong(node.key_of("name"), "is the same for " + std::to_string(group.count) + " videos; add {number}");
}

VideoGroup read_group(RecipeNode node, const Recipe& recipe, const std::vector<std::string>& settings) {
  VideoGroup group;
  read_count(node, group);
  const std::vector<std::string> backgrounds = names_of(recipe.backgrounds);
  group.backgrounds = selected_names(node, "backgrounds", backgrounds, backgrounds);
  group.aircraft = selected_names(node, "aircraft", names_of(recipe.aircraft), intruders_of(recipe));
  group.flights = flights_in(node, group.is_sampled);
  group.lights = read_lights(node, settings);
  group.appearance = read_appearance(node, settings);
  group.others = read_others(node, recipe);
  group.name = node.text("name").value_or(standard_name(group));
  group.frames = node.whole("frames", 1, kMaxFrames);
  group.first_frame = read_quantity(node, "first_frame").value_or(Quantity{});
  if (span_of(group.first_frame).low < 0) node.log().wrong(node.key_of("first_frame"), "must not be less than 0");
  group.split = node.text("split").value_or("");
  group.tags = node.text_map("tags");
  if (const std::string wrong = wrong_with_pattern(group.name); !wrong.empty())
    node.log().wrong(node.key_of("name"), wrong);
  if (group.is_sampled) check_sampled_name(group, node);
  check_split(group.split, node, recipe);
  check_tags(group.tags, node);
  node.done();
  return group;
}

}  // namespace

void check_tags(const std::map<std::string, std::string>& tags, RecipeNode& node) {
  for (const char* const own : {"background", "aircraft", "flight"})
    if (tags.contains(own)) node.log().wrong(node.key_of("tags") + "." + own, "is set by itself; choose another name");
}

std::vector<VideoGroup> read_groups(RecipeNode& recipe_node, const Recipe& recipe,
                                    const std::vector<std::string>& settings) {
  const Json* const number = recipe_node.value("videos");
  if (number != nullptr && number->is_number()) {  // one group without other keys
    const Json group{{"videos", *number}};
    return {read_group(RecipeNode(group, "", recipe_node.log()), recipe, settings)};
  }
  std::vector<VideoGroup> groups;
  double videos = 0;
  for (const RecipeNode& node : recipe_node.nodes("videos")) {
    groups.push_back(read_group(node, recipe, settings));
    const VideoGroup& group = groups.back();
    const double combinations =
        double(group.backgrounds.size()) * double(group.aircraft.size()) * double(group.flights.size());
    videos += group.count * (group.is_sampled ? 1 : combinations);
  }
  if (videos > kMaxVideos)
    recipe_node.log().wrong("videos",
                            fmt::format("make {} videos; a recipe may have {}", short_number_text(videos), kMaxVideos));
  return groups;
}

void read_splits(RecipeNode& recipe_node, Recipe& recipe) {
  const Json* const json = recipe_node.value("splits");
  if (json == nullptr) return;
  RecipeNode node(*json, "splits", recipe_node.log());
  recipe.keep_together = node.text("keep_together").value_or("");
  double sum = 0;
  if (json->is_object())
    for (const auto& [name, item] : json->items()) {
      if (name == "keep_together") continue;
      const double share = item.is_number() ? item.get<double>() : -1;
      if (!(share >= 0 && share <= 1)) node.log().wrong(node.key_of(name), "expected a share from 0 to 1");
      if (const std::string wrong = file_name_error(name); !wrong.empty()) node.log().wrong(node.key_of(name), wrong);
      recipe.splits.push_back({name, share});
      sum += share;
    }
  if (std::abs(sum - 1) > 1e-6)
    node.log().wrong("splits", fmt::format("have shares that add up to {}, not 1", short_number_text(sum)));
}

LightSettings with_sampled_light(LightSettings light, const std::map<std::string, double>& sampled) {
  const std::array<double*, 7> values{&light.position_m.x, &light.position_m.y, &light.position_m.z, &light.color.x,
                                      &light.color.y,      &light.color.z,      &light.ambient};
  std::size_t i = 0;
  for (const LightField& field : light_fields())
    for (const char* const name : field.names) {
      if (const auto found = sampled.find(name); found != sampled.end()) *values[i] = found->second;
      ++i;
    }
  return light;
}

}  // namespace sigs
