// SPDX-License-Identifier: MIT
#include "dataset/recipe_sections.h"

#include <algorithm>
#include <array>
#include <filesystem>

#include "project/fields.h"
#include "project/validate.h"

namespace sigs {

namespace {

// What the recipe itself says for each video; where to say it.
constexpr std::array<std::pair<std::string_view, std::string_view>, 4> kPerVideoSettings{
    {{"name", "videos[].name"},
     {"footage.", "backgrounds[].footage"},
     {"intruders[0].name", "aircraft[].name"},
     {"intruders[0].model.", "aircraft[].model"}}};

void make_paths_absolute(Project& project) {
  std::error_code code;
  const std::filesystem::path folder = std::filesystem::absolute(project.file, code).parent_path();
  for (const Field& field : fields_of(project))
    if (auto* const text = std::get_if<std::string*>(&field.value); field.is_path && text && !(*text)->empty())
      **text = (folder / **text).lexically_normal().string();
}

// "attitude_deg.roll" -> /attitude_deg/roll
Json::json_pointer pointer_of(const std::string& key) {
  std::string pointer = "/" + key;
  std::replace(pointer.begin(), pointer.end(), '.', '/');
  return Json::json_pointer(pointer);
}

// Of what is left once all fields are taken out.
void warn_of_unknown_keys(const Json& rest, const std::string& key, RecipeLog& log) {
  for (const auto& [name, item] : rest.items())
    if (item.is_object())
      warn_of_unknown_keys(item, key + "." + name, log);
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

void put_section(const Json& section, const std::string& project_key, const std::string& key, Project& project,
                 RecipeLog& log) {
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

}  // namespace

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

std::vector<std::string> read_settings(RecipeNode& recipe, Project& base) {
  std::vector<std::string> settings;
  const Json* const json = recipe.value("settings");
  if (json == nullptr) return settings;
  if (!json->is_object()) recipe.log().wrong("settings", "expected {\"KEY\": VALUE}, keys as --set takes them");
  for (const auto& [key, item] : json->items()) {
    settings.push_back(key + "=" + (item.is_string() ? item.get<std::string>() : item.dump()));
    if (const std::string wrong = put_setting(settings.back(), base); !wrong.empty())
      recipe.log().wrong("settings." + key, wrong);
  }
  return settings;
}

void add_settings(const std::vector<std::string>& more, std::vector<std::string>& settings, Project& base,
                  RecipeLog& log) {
  for (const std::string& setting : more) {
    settings.push_back(setting);
    if (const std::string wrong = put_setting(setting, base); !wrong.empty() && !log.error)
      log.error = Error{"--set " + setting, wrong, ErrorKind::usage};
  }
}

void apply_settings(const std::vector<std::string>& settings, Project& project) {
  for (const std::string& setting : settings)
    if (!set_field(project, setting)) return;  // add_settings() has told of it
  make_paths_absolute(project);
}

void warn_of_overridden(RecipeNode& recipe) {
  const Json* const settings = recipe.value("settings");
  const Json* const backgrounds = recipe.value("backgrounds");
  if (settings == nullptr || !settings->is_object() || backgrounds == nullptr || !backgrounds->is_array()) return;
  for (const auto& [key, item] : settings->items()) {
    if (!key.starts_with("camera.") && !key.starts_with("light.")) continue;
    const Json::json_pointer place = pointer_of(key);
    const auto says = [&](const Json& background) { return background.contains(place); };
    if (std::all_of(backgrounds->begin(), backgrounds->end(), says))
      recipe.log().warn("settings." + key, "has no effect: every background says its own " + key);
  }
}

}  // namespace sigs
