// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <string>
#include <variant>
#include <vector>

#include "base/paths.h"
#include "base/text.h"
#include "dataset/recipe.h"
#include "dataset/recipe_reading.h"
#include "project/fields.h"
#include "project/json.h"

namespace sigs {

namespace {

bool has(const std::vector<std::string>& names, const std::string& name) {
  return std::ranges::count(names, name) > 0;
}

bool is_one_number(const Field& field) {
  return std::holds_alternative<double*>(field.value) || std::holds_alternative<int*>(field.value) ||
         std::holds_alternative<std::optional<double>*>(field.value);
}

bool is_given_beside(const std::vector<std::string>& settings, const std::string& key) {
  return std::ranges::any_of(
      settings, [&](const std::string& setting) { return current_key(setting.substr(0, setting.find('='))) == key; });
}

// The numbers of a section under the names that settings have today.
Json with_current_keys(const Json& json, const std::string& section, RecipeNode& group) {
  if (!json.is_object()) return json;
  Json renamed = Json::object();
  for (const auto& [key, value] : json.items()) {
    const std::string today = current_key(section + "." + key).substr(section.size() + 1);
    if (today != key)
      group.log().warn(group.key_of(section) + "." + key, "is called " + today + " today; read as that");
    renamed[today] = value;
  }
  return renamed;
}

// A quantity within limits of the project; none, and an error in the log: it is another, or beyond them.
std::optional<Quantity> limited_quantity(const Json& json, const std::string& where, const Field& field,
                                         RecipeLog& log) {
  const Possible<Quantity> quantity = quantity_of(json);
  const Span span = quantity ? span_of(*quantity) : Span{};
  const bool is_within = span.low >= field.minimum && span.high <= field.maximum;
  if (quantity && is_within) return *quantity;
  log.wrong(where, quantity
                       ? fmt::format("must lie between {} and {}; a normal quantity needs \"low\" and \"high\" for "
                                     "that",
                                     short_number_text(field.minimum), short_number_text(field.maximum))
                       : quantity.error());
  return std::nullopt;
}

template <class Named>
std::vector<std::string> names_of(const std::vector<Named>& all) {
  std::vector<std::string> names;
  for (const Named& one : all) names.push_back(one.name);
  return names;
}

OthersPlan read_other(RecipeNode node, const Recipe& recipe) {
  OthersPlan others;
  const std::vector<std::string> there = names_of(recipe.aircraft);
  others.aircraft = selected_names(node, "aircraft", there, there);
  others.flights = read_flights(node.value("flights"), node.key_of("flights"), node.log());
  others.count = quantity_between(node, "count", 0, kMaxOthers).value_or(others.count);
  node.done();
  return others;
}

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

// As the project has it.
Field field_of(Project& project, const std::string& key) {
  const std::vector<Field> fields = fields_of(project);
  return *std::ranges::find(fields, key, &Field::key);
}

void read_light_field(RecipeNode& node, const LightField& light_field, LightPlan& light) {
  const Json* const json = node.value(light_field.key);
  if (json == nullptr) return;
  Project project;
  const Field field = field_of(project, std::string("light.") + light_field.key);
  const std::string where = node.key_of(light_field.key);
  const std::size_t count = light_field.names.size();
  if (count > 1 && (!json->is_array() || json->size() != count))
    return node.log().wrong(where, "expected a list of three quantities");
  for (std::size_t i = 0; i < count; ++i) {
    const std::string place = count == 1 ? where : fmt::format("{}[{}]", where, i);
    if (const auto quantity = limited_quantity(count == 1 ? *json : json->at(i), place, field, node.log()))
      light.quantities[light_field.names[i]] = *quantity;
  }
}

LightPlan read_light(RecipeNode node, const std::vector<std::string>& settings) {
  LightPlan light;
  for (const LightField& field : light_fields()) {
    read_light_field(node, field, light);
    if (is_given_beside(settings, std::string("light.") + field.key))
      for (const char* const name : field.names) light.quantities.erase(name);
  }
  light.numbers = numbers_in(node, "light", settings, {"ambient"});
  node.done();
  return light;
}

// A group's "light": { ... } or a list of them, each with "position_m", "color" (three quantities each) and "ambient"
// (one), all of them optional, and other numbers of the project below `light` by their keys. What `settings` (KEY=VALUE
// given beside the recipe) set is left out, since it takes precedence. Values outside the limits of a project are
// mistakes.
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
constexpr int kResamples = 100;           // of sampled groups without one
constexpr int kResamplesOfImages = 1000;  // which keep their frame, in which there may be little room
constexpr int kMaxResamples = 10'000;

// The flights of a sampled group without any. docs/dataset-recipe.md shows them.
constexpr const char* kRandomEncounter = R"([{"kind": "encounter",
  "miss_distance_m": {"uniform": [0, 150]}, "miss_angle_deg": {"uniform": [-180, 180]},
  "bearing_deg": {"uniform": [-45, 45]}, "elevation_deg": {"uniform": [-10, 10]},
  "closing_speed_mps": {"uniform": [40, 160]}}])";

// The flights of a group of images without any.
constexpr const char* kRandomPosition = R"([{"kind": "image_position",
  "x_percent": {"uniform": [0, 100]}, "y_percent": {"uniform": [0, 100]}, "size_px": {"log_uniform": [8, 128]},
  "relative_speed_mps": {"uniform": [10, 120]}, "course_deg": {"uniform": [-180, 180]},
  "climb_deg": {"normal": {"mean": 0, "deviation": 4, "low": -15, "high": 15}},
  "nose_deg": {"normal": {"mean": 0, "deviation": 20, "low": -180, "high": 180}}}])";

// All aircraft that are no distractors; where there are none, all.
std::vector<std::string> intruders_of(const Recipe& recipe) {
  std::vector<std::string> names;
  for (const Aircraft& aircraft : recipe.aircraft)
    if (!aircraft.is_distractor) names.push_back(aircraft.name);
  return names.empty() ? names_of(recipe.aircraft) : names;
}

// The flights of a group; of a sampled one without any the standard encounter, of images the standard place and size.
std::vector<FlightPlan> flights_in(RecipeNode& node, const VideoGroup& group) {
  static const Json random_encounter = Json::parse(kRandomEncounter);
  static const Json random_position = Json::parse(kRandomPosition);
  const Json* list = node.value("flights");
  if (list == nullptr && group.is_sampled) list = group.is_images ? &random_position : &random_encounter;
  std::vector<FlightPlan> flights = read_flights(list, node.key_of("flights"), node.log());
  for (std::size_t i = 0; i < flights.size() && group.is_images; ++i)
    if (flights[i].kind != FlightKind::image_position)
      node.log().wrong(fmt::format("{}[{}].kind", node.key_of("flights"), i),
                       "must be image_position: an image has one moment");
  return flights;
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
  const std::optional<int> images = node.whole("images", 1, kMaxVideos);
  const std::optional<int> videos = node.whole("videos", 1, kMaxVideos);
  const std::optional<int> count = node.whole("count", 1, kMaxVideos);
  group.is_images = node.value("images") != nullptr;
  group.is_sampled = group.is_images || node.value("videos") != nullptr;
  if (group.is_images && node.value("videos") != nullptr)
    node.log().wrong(node.key_of("images"), "stands beside videos; give one of the two");
  if (group.is_sampled && node.value("count") != nullptr)
    node.log().wrong(node.key_of("count"),
                     "counts each combination, videos and images are so many in all; give one of them");
  group.count = images.value_or(videos.value_or(count.value_or(1)));
  group.resamples = node.whole("redraws", 0, kMaxResamples);
  if (group.is_sampled && !group.resamples) group.resamples = group.is_images ? kResamplesOfImages : kResamples;
}

// What a group of images has in place of a length.
void read_image_keys(RecipeNode& node, VideoGroup& group) {
  for (const char* const key : {"frames", "others"})
    if (group.is_images && node.value(key) != nullptr)
      node.log().wrong(node.key_of(key), "is of videos; an image has one frame, and per_image aircraft");
  for (const char* const key : {"per_image", "placement"})
    if (!group.is_images && node.value(key) != nullptr)
      node.log().wrong(node.key_of(key), "is of images; say \"images\": N in place of videos or count");
  group.per_image = quantity_between(node, "per_image", 0, kMaxOthers).value_or(group.per_image);
  const std::string placement = node.text("placement").value_or("anywhere");
  if (placement == "sky") group.placement = Placement::sky;
  if (placement == "land") group.placement = Placement::land;
  if (placement != "sky" && placement != "land" && placement != "anywhere")
    node.log().wrong(node.key_of("placement"), fmt::format("is \"{}\"; there are sky, land, anywhere", placement));
  if (group.is_images) group.frames = 1;
}

std::string standard_name(const VideoGroup& group) {
  if (group.is_images) return "image-{number}";
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
    node.log().wrong(node.key_of("name"), fmt::format("is the same for {} videos; add {{number}}", group.count));
}

VideoGroup read_group(RecipeNode node, const Recipe& recipe, const std::vector<std::string>& settings) {
  VideoGroup group;
  read_count(node, group);
  const std::vector<std::string> backgrounds = names_of(recipe.backgrounds);
  group.backgrounds = selected_names(node, "backgrounds", backgrounds, backgrounds);
  group.aircraft = selected_names(node, "aircraft", names_of(recipe.aircraft), intruders_of(recipe));
  group.flights = flights_in(node, group);
  group.lights = read_lights(node, settings);
  group.numbers = read_numbers(node, "appearance", settings);
  group.numbers.merge(read_numbers(node, "camera", settings));
  group.numbers.merge(
      read_numbers(node, "footage", settings,
                   {"frame_rate", "first_frame", "last_frame", "occluder_frame", "max_substituted_percent"}));
  group.others = read_others(node, recipe);
  group.name = node.text("name").value_or(standard_name(group));
  group.frames = node.whole("frames", 1, kMaxFrames);
  read_image_keys(node, group);
  group.first_frame = read_quantity(node, "first_frame");
  if (group.first_frame && span_of(*group.first_frame).low < 0)
    node.log().wrong(node.key_of("first_frame"), "must not be less than 0");
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

std::map<std::string, Quantity> numbers_in(RecipeNode& node, const std::string& section,
                                           const std::vector<std::string>& settings,
                                           const std::vector<std::string>& left_out) {
  std::map<std::string, Quantity> numbers;
  Project project;
  project.intruders.resize(1);
  for (const Field& field : fields_of(project)) {
    if (!field.key.starts_with(section + ".") || !is_one_number(field)) continue;
    const std::string name = field.key.substr(section.size() + 1);
    if (has(left_out, name)) continue;
    const Json* const value = node.value(name);
    if (value == nullptr || is_given_beside(settings, field.key)) continue;
    if (const auto quantity = limited_quantity(*value, node.key_of(name), field, node.log()))
      numbers[field.key] = *quantity;
  }
  return numbers;
}

std::map<std::string, Quantity> read_numbers(RecipeNode& group, const std::string& section,
                                             const std::vector<std::string>& settings,
                                             const std::vector<std::string>& left_out) {
  const Json* const json = group.value(section);
  if (json == nullptr) return {};
  const Json renamed = with_current_keys(*json, section, group);
  RecipeNode node(renamed, group.key_of(section), group.log());
  std::map<std::string, Quantity> numbers = numbers_in(node, section, settings, left_out);
  node.done();
  return numbers;
}

std::vector<OthersPlan> read_others(RecipeNode& group, const Recipe& recipe) {
  std::vector<OthersPlan> others;
  if (group.value("others") == nullptr) return others;
  for (RecipeNode& node : group.nodes("others")) others.push_back(read_other(std::move(node), recipe));
  return others;
}

std::vector<std::string> selected_names(RecipeNode& group, const char* key, const std::vector<std::string>& there,
                                        const std::vector<std::string>& standard) {
  std::vector<std::string> names = group.texts(key);
  if (names.empty()) return standard;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const std::string where = fmt::format("{}[{}]", group.key_of(key), i);
    if (!has(there, names[i]))
      group.log().wrong(where, fmt::format("no such name: \"{}\"; there are {}", names[i], listed(there)));
    if (std::count(names.begin(), names.end(), names[i]) > 1)
      group.log().wrong(where, fmt::format("stands there twice: \"{}\"", names[i]));
  }
  return names;
}

void check_tags(const std::map<std::string, std::string>& tags, RecipeNode& node) {
  for (const char* const own : {"background", "aircraft", "flight"})
    if (tags.contains(own)) node.log().wrong(node.key_of("tags") + "." + own, "is set by itself; choose another name");
}

std::vector<VideoGroup> read_groups(RecipeNode& recipe_node, const Recipe& recipe,
                                    const std::vector<std::string>& settings) {
  const Json* const videos_json = recipe_node.value("videos");
  const Json* const images_json = recipe_node.value("images");
  if (images_json != nullptr && videos_json != nullptr)
    recipe_node.log().wrong("images", "stands beside videos; give one of the two, or groups with images in videos");
  if (images_json != nullptr || (videos_json != nullptr && videos_json->is_number())) {  // one group without other keys
    const Json group = images_json != nullptr ? Json{{"images", *images_json}} : Json{{"videos", *videos_json}};
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

std::string setting_of_light(const std::string& name) {
  for (const LightField& field : light_fields())
    if (std::ranges::count(field.names, name) > 0) return std::string("light.") + field.key;
  return {};
}

}  // namespace sigs
