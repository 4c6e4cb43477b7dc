// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <optional>
#include <string>
#include <vector>

#include "dataset/matched_look.h"
#include "dataset/recipe.h"
#include "dataset/recipe_reading.h"
#include "first_project/first_project.h"
#include "project/fields.h"
#include "project/json.h"

namespace sigs {

namespace {

// Takes footage, camera, light and appearance of the project that a background names.
void read_project_of(RecipeNode& node, Project& project) {
  const std::optional<std::string> name = node.text("project");
  if (!name) return;
  Result<ReadProject> loaded = read_project(from_recipe_folder(node, *name));
  if (!loaded) return node.log().wrong(node.key_of("project"), loaded.error().text(), loaded.error().kind);
  make_paths_absolute(loaded->project);
  project.footage = loaded->project.footage;
  project.cameras = loaded->project.cameras;
  project.camera = loaded->project.camera;
  project.light = loaded->project.light;
  project.appearance = loaded->project.appearance;
}

// Whether the camera's height is one that `sigs init` guessed for the project that a background names.
bool height_is_guess(RecipeNode& node, Project project) {
  const std::optional<std::string> name = node.text("project");
  if (!name) return false;
  project.file = from_recipe_folder(node, *name);
  return is_still_guessed(project, "camera.position_m");
}

// Flights are planned about a camera that is turned as `camera` says.
void check_cameras(const std::vector<RigCamera>& cameras, RecipeNode& node) {
  if (cameras.empty()) return;
  const MountSettings& first = cameras.front().mount;
  if (first.roll_deg != 0 || first.pitch_deg != 0 || first.yaw_deg != 0)
    node.log().wrong(node.key_of("project"),
                     fmt::format("has a first camera, \"{}\", whose mount is turned; flights are planned about the "
                                 "first one: put one that looks ahead first",
                                 cameras.front().name));
}

// "appearance": as in a project file, or "matched": gives back whether it is that. Another text is an error.
bool read_appearance(RecipeNode& node, Project& project) {
  const Json* const json = node.value("appearance");
  if (json == nullptr) return false;
  if (!json->is_string()) read_section(node, "appearance", "appearance", project);
  if (json->is_string() && *json != "matched")
    node.log().wrong(
        node.key_of("appearance"),
        fmt::format("is {}; there are \"matched\", as the footage looks, and {{ ... }}, as a project has it",
                    shown(*json)));
  return *json == "matched";
}

// What measuring the footage would set and the recipe states all the same: in `settings` (KEY=VALUE), and as the
// background's own light.
std::vector<std::string> stated_settings(RecipeNode& node, const std::vector<std::string>& settings, Project& project) {
  std::vector<std::string> stated;
  for (const std::string& setting : settings)
    if (const std::string key = current_key(setting.substr(0, setting.find('='))); may_be_measured(key))
      stated.push_back(key);
  const Json* const light = node.value("light");
  if (light == nullptr || !light->is_object()) return stated;
  Json section = *light;
  static_cast<void>(rename_old_keys(section, "light", ""));
  for (const Field& field : fields_of(project))
    if (field.key.starts_with("light.") && section.contains(pointer_of(field.key.substr(std::string("light.").size()))))
      stated.push_back(field.key);
  return stated;
}

// Puts what the recipe's settings (KEY=VALUE) state of the look over that of a background's project, in whose place the
// measured one will stand.
void put_stated_look(const std::vector<std::string>& settings, Project& project) {
  for (const std::string& setting : settings)
    if (may_be_measured(current_key(setting.substr(0, setting.find('=')))))
      static_cast<void>(set_field(project, setting));  // add_settings() has reported it
}

// Measures are of one camera.
void check_match(const Background& background, RecipeNode& node) {
  if (background.is_matched && !background.cameras.empty())
    node.log().wrong(node.key_of("appearance"),
                     "is \"matched\", which is of one camera, and the project has several; measure each of them by "
                     "`sigs appearance PROJECT --camera NAME --into PROJECT` and leave it out");
}

}  // namespace

Background read_background(RecipeNode node, const Project& base, const std::vector<std::string>& settings,
                           const std::vector<std::string>& beside) {
  Project project = base;
  Background background{.name = node.needed_text("name"), .tags = node.text_map("tags")};
  read_project_of(node, project);
  background.is_matched = read_appearance(node, project);
  if (background.is_matched) {
    put_stated_look(settings, project);
    background.stated = stated_settings(node, settings, project);
  }
  read_section(node, "footage", "footage", project);
  read_section(node, "camera", "camera", project);
  read_section(node, "light", "light", project);
  apply_settings(beside, project);
  background.footage = project.cameras.empty() ? project.footage : project.cameras.front().footage;
  background.cameras = project.cameras;
  check_cameras(background.cameras, node);
  background.camera = project.camera;
  background.light = project.light;
  background.appearance = project.appearance;
  background.height_is_guess = background.is_matched && height_is_guess(node, project);
  check_match(background, node);
  check_tags(background.tags, node);
  read_origin(node);
  node.done();
  return background;
}

}  // namespace sigs
