// SPDX-License-Identifier: MIT
#include "dataset/recipe.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/paths.h"
#include "base/staged_outputs.h"
#include "base/text.h"
#include "dataset/recipe_reading.h"
#include "project/fields.h"
#include "project/json.h"
#include "project/validate.h"

namespace sigs {

namespace {

// Settings that the recipe has elsewhere for each video; where they belong.
constexpr std::array<std::pair<std::string_view, std::string_view>, 5> kPerVideoSettings{
    {{"name", "videos[].name"},
     {"footage.", "backgrounds[].footage"},
     {"intruders[0].name", "aircraft[].name"},
     {"intruders[0].role", "aircraft[].distractor"},
     {"intruders[0].model.", "aircraft[].model"}}};

// Of the keys that remain once all fields are removed.
void warn_of_unknown_keys(const Json& rest, const std::string& key, RecipeLog& log) {
  for (const auto& [name, item] : rest.items())
    if (item.is_object())
      warn_of_unknown_keys(item, key + "." + name, log);
    else if (item.is_array() && !item.empty() && std::ranges::all_of(item, &Json::is_object))
      for (std::size_t i = 0; i < item.size(); ++i)
        warn_of_unknown_keys(item[i], fmt::format("{}.{}[{}]", key, name, i), log);
    else
      log.warn(key + "." + name, "unknown key, not used");
}

// A group of fields written as one value ("attitude_deg": 5) would hide them.
void check_groups(const Json& section, const std::string& rest_of_key, const std::string& key, RecipeLog& log) {
  for (std::size_t dot = rest_of_key.rfind('.'); dot != std::string::npos && dot > 0;
       dot = rest_of_key.rfind('.', dot - 1)) {
    const std::string group = rest_of_key.substr(0, dot);
    const Json::json_pointer place = pointer_of(group);
    if (section.contains(place) && !section.at(place).is_object()) log.wrong(key + "." + group, "expected { ... }");
  }
}

void put_section(Json section, const std::string& project_key, const std::string& key, Project& project,
                 RecipeLog& log) {
  for (const Warning& old : rename_old_keys(section, project_key, key + ".")) log.warn(old.where, old.what);
  Json rest = section;
  for (const Field& field : fields_of(project)) {
    if (!field.key.starts_with(project_key + ".")) continue;
    const std::string name = field.key.substr(project_key.size() + 1);
    check_groups(section, name, key, log);
    const Json::json_pointer place = pointer_of(name);
    if (!section.contains(place)) continue;
    if (const std::string wrong = put_json(section.at(place), field); !wrong.empty())
      log.wrong(key + "." + name, wrong);
    rest.at(place.parent_pointer()).erase(place.back());
  }
  warn_of_unknown_keys(rest, key, log);
}

// What is wrong with a setting for all videos; empty: nothing, and the project has it.
std::string put_setting(const std::string& assignment, Project& base) {
  const std::string key = assignment.substr(0, assignment.find('='));
  for (const auto& [owned, owner] : kPerVideoSettings)
    if (owned.ends_with('.') ? key.starts_with(owned) : key == owned)
      return "is not the same for all videos; say it in " + std::string(owner);
  const Result<void> set = set_field(base, assignment);
  if (!set) return set.error().what;
  make_paths_absolute(base);
  for (const Problem& problem : validate(base))
    if (problem.field == key) return problem.what;
  return {};
}

// Reads "settings": {KEY: VALUE} of the recipe into the project. Returns them as KEY=VALUE.
std::vector<std::string> read_settings(RecipeNode& recipe, Project& base) {
  std::vector<std::string> settings;
  const Json* const json = recipe.value("settings");
  if (json == nullptr) return settings;
  if (!json->is_object()) recipe.log().wrong("settings", "expected {\"KEY\": VALUE}, keys as projects have them");
  for (const auto& [key, item] : json->items()) {
    settings.push_back(key + "=" + (item.is_string() ? item.get<std::string>() : item.dump()));
    if (const std::string wrong = put_setting(settings.back(), base); !wrong.empty())
      recipe.log().wrong("settings." + key, wrong);
  }
  return settings;
}

// Adds KEY=VALUE given beside the recipe to the list and to the project. Errors are logged as kind usage.
void add_settings(const std::vector<std::string>& more, std::vector<std::string>& settings, Project& base,
                  RecipeLog& log) {
  for (const std::string& setting : more) {
    settings.push_back(setting);
    if (const std::string wrong = put_setting(setting, base); !wrong.empty() && !log.error)
      log.error = Error{setting, wrong, ErrorKind::usage};
  }
}

// Warns of settings of a background that have no effect, since every background has its own.
void warn_of_overridden(RecipeNode& recipe) {
  const Json* const settings = recipe.value("settings");
  const Json* const backgrounds = recipe.value("backgrounds");
  if (settings == nullptr || !settings->is_object() || backgrounds == nullptr || !backgrounds->is_array()) return;
  for (const auto& [key, item] : settings->items()) {
    if (!key.starts_with("camera.") && !key.starts_with("light.") && !key.starts_with("appearance.")) continue;
    const Json::json_pointer place = pointer_of(key);
    const auto says = [&](const Json& background) { return background.contains(place); };
    if (std::ranges::all_of(*backgrounds, says))
      recipe.log().warn("settings." + key, "has no effect: every background says its own " + key);
  }
}

constexpr int kRecipeVersion = 1;

Result<void> check_version(const Json& json, const std::string& file) {
  const std::string key = file + ": sigs_dataset";
  if (!json.is_object()) return fail(file, "is not a recipe: expected { ... }");
  if (json.contains("sigs")) return fail(file, "is a project, not a recipe; `sigs export` makes its video");
  const auto version = json.find("sigs_dataset");
  if (version == json.end()) return fail(key, "missing; a recipe begins with \"sigs_dataset\": 1");
  if (!version->is_number_integer() || *version != kRecipeVersion)
    return fail(key, fmt::format("version {} is not known; this program reads version 1", shown(*version)));
  return {};
}

std::uint64_t read_seed(RecipeNode& node) {
  const Json* const json = node.value("seed");
  if (json == nullptr) return 0;
  if (json->is_number_unsigned()) return json->get<std::uint64_t>();
  node.log().wrong(node.key_of("seed"),
                   "expected a whole number from 0 to 18446744073709551615, found " + shown(*json));
  return 0;
}

template <class Named>
void check_names(const std::vector<Named>& all, const std::string& key, RecipeLog& log) {
  for (std::size_t i = 0; i < all.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (all[i].name == all[j].name)
        log.wrong(fmt::format("{}[{}].name", key, i), fmt::format("stands there twice: \"{}\"", all[i].name));
}

// Images are frames of one camera.
void check_images(const Recipe& recipe, RecipeLog& log) {
  for (const VideoGroup& group : recipe.groups)
    for (const Background& background : recipe.backgrounds)
      if (group.is_images && !background.cameras.empty() && std::ranges::count(group.backgrounds, background.name) > 0)
        log.wrong("images", fmt::format("have the background \"{}\" with several cameras; take videos, or name other "
                                        "backgrounds",
                                        background.name));
}

std::optional<Span> read_speed_limits(RecipeNode& node) {
  const Json* const json = node.value("speed_limits_mps");
  if (json == nullptr) return std::nullopt;
  const bool is_pair = json->is_array() && json->size() == 2 && json->at(0).is_number() && json->at(1).is_number();
  const Span limits = is_pair ? Span{json->at(0).get<double>(), json->at(1).get<double>()} : Span{1, 0};
  if (limits.low < 0 || limits.low > limits.high)
    node.log().wrong(node.key_of("speed_limits_mps"), "expected [lowest, highest], found " + shown(*json));
  return limits;
}

std::vector<std::string> read_liveries(RecipeNode& node) {
  std::error_code code;
  std::vector<std::string> files;
  for (const std::string& name : node.texts("liveries")) {
    const std::filesystem::path file = from_recipe_folder(node, name);
    if (!std::filesystem::is_regular_file(file, code))
      node.log().wrong(fmt::format("{}[{}]", node.key_of("liveries"), files.size()),
                       file.string() + " is no file that can be read", ErrorKind::cannot_read);
    files.push_back(file.string());
  }
  return files;
}

bool read_distractor(RecipeNode& node) {
  const Json* const json = node.value("distractor");
  if (json != nullptr && !json->is_boolean())
    node.log().wrong(node.key_of("distractor"), "expected true or false, found " + shown(*json));
  return json != nullptr && json->is_boolean() && json->get<bool>();
}

// "contrail": {"strands": QUANTITY, ..., "above_m": 8000}
void read_contrail(RecipeNode& node, Aircraft& aircraft) {
  const Json* const json = node.value("contrail");
  if (json == nullptr) return;
  RecipeNode contrail(*json, node.key_of("contrail"), node.log());
  aircraft.contrail = numbers_in(contrail, "intruders[0].contrail", {}, {});
  const Quantity above_m = read_quantity(contrail, "above_m").value_or(Quantity{});
  if (above_m.kind != Quantity::Kind::fixed) node.log().wrong(contrail.key_of("above_m"), "must be one number");
  aircraft.contrail_above_m = above_m.value;
  contrail.done();
}

// "heat": {"skin": QUANTITY, ...}, "lights": {"strobe_cd": QUANTITY, ...}
void read_drawn(RecipeNode& node, const char* section, Aircraft& aircraft) {
  const Json* const json = node.value(section);
  if (json == nullptr) return;
  RecipeNode part(*json, node.key_of(section), node.log());
  aircraft.drawn.merge(numbers_in(part, std::string("intruders[0].") + section, {}, {}));
  part.done();
}

// As many as "model" lists, for read_section().
void make_room_for_rotors(RecipeNode& node, ModelSettings& model) {
  const Json* const section = node.value("model");
  if (section == nullptr || !section->is_object() || !section->contains("rotors")) return;
  const Json& rotors = section->at("rotors");
  const std::string key = node.key_of("model") + ".rotors";
  if (!rotors.is_array()) return node.log().wrong(key, "expected a list [ ... ], found " + shown(rotors));
  if (rotors.size() > kMaxRotors)
    return node.log().wrong(key, fmt::format("has {} entries; at most {} are read", rotors.size(), kMaxRotors));
  model.rotors.assign(rotors.size(), {});
}

Aircraft read_aircraft(RecipeNode node, const Project& base) {
  Project project = base;
  IntruderSettings& intruder = project.intruders.front();
  Aircraft aircraft{.name = node.needed_text("name"), .tags = node.text_map("tags")};
  aircraft.category = node.text("category").value_or(aircraft.category);
  if (aircraft.category.empty()) node.log().wrong(node.key_of("category"), "is empty; labels count by it");
  make_room_for_rotors(node, intruder.model);
  read_section(node, "model", "intruders[0].model", project);
  aircraft.model = intruder.model;
  aircraft.liveries = read_liveries(node);
  aircraft.scale = quantity_between(node, "scale", 1e-3, 1e3).value_or(aircraft.scale);
  aircraft.is_distractor = read_distractor(node);
  aircraft.speed_limits_mps = read_speed_limits(node);
  read_contrail(node, aircraft);
  // A factor of the highlights, for each video.
  if (const std::optional<Quantity> gloss = quantity_between(node, "gloss", 0, 100))
    aircraft.drawn["intruders[0].model.gloss"] = *gloss;
  for (const char* const section : {"heat", "lights"}) read_drawn(node, section, aircraft);
  check_tags(aircraft.tags, node);
  read_origin(node);
  node.done();
  return aircraft;
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

Project project_without_settings(const std::filesystem::path& file) {
  Project base;
  base.file = file;
  base.intruders.resize(1);
  return base;
}

// Whether all that a recipe makes is images.
bool makes_images_alone(RecipeNode& node) {
  if (node.value("images") != nullptr) return true;
  const Json* const groups = node.value("videos");
  return groups != nullptr && groups->is_array() && !groups->empty() &&
         std::ranges::all_of(*groups, [](const Json& group) { return group.contains("images"); });
}

// What detectors are trained on, unless the settings say otherwise.
void set_defaults_of_images(ExportSettings& output) {
  output.codec = VideoCodec::png;
  output.masks = MasksChoice::none;
  output.labels = {"xml", "coco", "yolo"};
}

void read_into(Recipe& recipe, RecipeNode& node, const std::vector<std::string>& settings) {
  static_cast<void>(node.value("sigs_dataset"));
  recipe.name = node.needed_text("name");
  if (const std::string wrong = file_name_error(recipe.name); !wrong.empty()) node.log().wrong("name", wrong);
  recipe.seed = read_seed(node);
  if (makes_images_alone(node)) set_defaults_of_images(recipe.base.output);
  recipe.settings = read_settings(node, recipe.base);
  add_settings(settings, recipe.settings, recipe.base, node.log());
  for (const RecipeNode& background : node.nodes("backgrounds"))
    recipe.backgrounds.push_back(read_background(background, recipe.base, recipe.settings, settings));
  for (const RecipeNode& aircraft : node.nodes("aircraft"))
    recipe.aircraft.push_back(read_aircraft(aircraft, recipe.base));
  warn_of_overridden(node);
  check_names(recipe.backgrounds, "backgrounds", node.log());
  check_names(recipe.aircraft, "aircraft", node.log());
  read_splits(node, recipe);
  recipe.groups = read_groups(node, recipe, settings);
  check_images(recipe, node.log());
  node.done();
}

}  // namespace

void make_paths_absolute(Project& project) {
  std::error_code code;
  const std::filesystem::path folder = std::filesystem::absolute(project.file, code).parent_path();
  for (const Field& field : fields_of(project))
    if (auto* const text = std::get_if<std::string*>(&field.value); field.is_path && text && !(*text)->empty())
      **text = (folder / **text).lexically_normal().string();
}

void read_section(RecipeNode& node, const std::string& name, const std::string& project_key, Project& project) {
  const std::string key = node.key_of(name);
  if (const Json* const section = node.value(name); section != nullptr) {
    if (!section->is_object()) return node.log().wrong(key, "expected { ... }");
    put_section(*section, project_key, key, project, node.log());
  }
  make_paths_absolute(project);
  for (const Problem& problem : validate(project))
    if (problem.field.starts_with(project_key + "."))
      node.log().wrong(key + problem.field.substr(project_key.size()), problem.what,
                       problem.kind == ErrorKind::cannot_read ? problem.kind : ErrorKind::bad_data);
}

void apply_settings(const std::vector<std::string>& settings, Project& project) {
  for (const std::string& setting : settings)
    if (!set_field(project, setting)) return;  // add_settings() has reported it
  make_paths_absolute(project);
}

void read_origin(RecipeNode& node) {
  for (const char* const key : {"licence", "source"}) static_cast<void>(node.text(key));
}

Result<ReadRecipe> parse_recipe(const std::string& text, const std::filesystem::path& path,
                                const std::vector<std::string>& settings) {
  const std::string file = path.string();
  std::vector<std::string> doubled;
  const Result<Json> json = parsed_json(text, file, ErrorKind::bad_data, &doubled);
  if (!json) return fail(json.error());
  if (const Result<void> checked = check_version(*json, file); !checked) return fail(checked.error());
  RecipeLog log{.file = file};
  ReadRecipe read{.recipe = {.file = path, .base = project_without_settings(path), .text = text}};
  RecipeNode node(*json, "", log);
  for (const std::string& key : doubled) log.warn(key, kIsDoubled);
  read_into(read.recipe, node, settings);
  if (log.error) return fail(*log.error);
  read.warnings = std::move(log.warnings);
  return read;
}

Result<ReadRecipe> read_recipe(const std::filesystem::path& path, const std::vector<std::string>& settings) {
  const Result<std::string> text = read_text(path, kProjectLimit_bytes);
  if (!text) return fail(text.error());
  return parse_recipe(*text, path, settings);
}

}  // namespace sigs
