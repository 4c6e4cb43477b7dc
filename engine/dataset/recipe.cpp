// SPDX-License-Identifier: MIT
#include "dataset/recipe.h"

#include <algorithm>

#include "base/staged_outputs.h"
#include "dataset/quantity_json.h"
#include "dataset/recipe_node.h"
#include "dataset/recipe_sections.h"
#include "dataset/recipe_videos.h"
#include "dataset/video_name.h"
#include "project/json_reading.h"

namespace sigs {

namespace {

constexpr int kRecipeVersion = 1;

Result<void> check_version(const Json& json, const std::string& file) {
  const std::string key = file + ": sigs_dataset";
  if (!json.is_object()) return fail(file, "is not a recipe: expected { ... }");
  if (json.contains("sigs")) return fail(file, "is a project, not a recipe; `sigs export` makes its video");
  const auto version = json.find("sigs_dataset");
  if (version == json.end()) return fail(key, "missing; a recipe begins with \"sigs_dataset\": 1");
  if (!version->is_number_integer() || *version != kRecipeVersion)
    return fail(key, "version " + shown(*version) + " is not known; this program reads version 1");
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
        log.wrong(key + "[" + std::to_string(i) + "].name", "stands there twice: \"" + all[i].name + "\"");
}

Background read_background(RecipeNode node, const Project& base, const std::vector<std::string>& settings) {
  Project project = base;
  Background background{.name = node.needed_text("name"), .tags = node.text_map("tags")};
  read_section(node, "footage", "footage", project);
  read_section(node, "camera", "camera", project);
  read_section(node, "light", "light", project);
  apply_settings(settings, project);
  background.footage = project.footage;
  background.camera = project.camera;
  background.light = project.light;
  check_tags(background.tags, node);
  node.done();
  return background;
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

Aircraft read_aircraft(RecipeNode node, const Project& base) {
  Project project = base;
  IntruderSettings& intruder = project.intruders.front();
  Aircraft aircraft{.name = node.needed_text("name"), .tags = node.text_map("tags")};
  aircraft.category = node.text("category").value_or(aircraft.category);
  if (aircraft.category.empty()) node.log().wrong(node.key_of("category"), "is empty; labels count by it");
  read_section(node, "model", "intruders[0].model", project);
  aircraft.model = intruder.model;
  aircraft.speed_limits_mps = read_speed_limits(node);
  check_tags(aircraft.tags, node);
  node.done();
  return aircraft;
}

Project project_without_settings(const std::filesystem::path& file) {
  Project base;
  base.file = file;
  base.intruders.resize(1);
  return base;
}

void read_into(Recipe& recipe, RecipeNode& node, const std::vector<std::string>& settings) {
  static_cast<void>(node.value("sigs_dataset"));
  recipe.name = node.needed_text("name");
  if (const std::string wrong = wrong_with_name(recipe.name); !wrong.empty()) node.log().wrong("name", wrong);
  recipe.seed = read_seed(node);
  recipe.settings = read_settings(node, recipe.base);
  add_settings(settings, recipe.settings, recipe.base, node.log());
  for (const RecipeNode& background : node.nodes("backgrounds"))
    recipe.backgrounds.push_back(read_background(background, recipe.base, settings));
  for (const RecipeNode& aircraft : node.nodes("aircraft"))
    recipe.aircraft.push_back(read_aircraft(aircraft, recipe.base));
  warn_of_overridden(node);
  check_names(recipe.backgrounds, "backgrounds", node.log());
  check_names(recipe.aircraft, "aircraft", node.log());
  read_splits(node, recipe);
  recipe.groups = read_groups(node, recipe, settings);
  node.done();
}

}  // namespace

Result<ReadRecipe> parse_recipe(const std::string& text, const std::filesystem::path& path,
                                const std::vector<std::string>& settings) {
  const std::string file = path.string();
  const Result<Json> json = parsed_json(text, file, ErrorKind::bad_data);
  if (!json) return fail(json.error());
  if (const Result<void> checked = check_version(*json, file); !checked) return fail(checked.error());
  RecipeLog log{.file = file};
  ReadRecipe read{.recipe = {.file = path, .base = project_without_settings(path), .text = text}};
  RecipeNode node(*json, "", log);
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
