// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "dataset/recipe_node.h"
#include "project/project.h"

namespace sigs {

// Reads the object `name` of a node ("camera") as a project file has it below `project_key` ("camera",
// "intruders[0].model") into the project, and looks whether what it says is right. Paths are taken from the folder of
// project.file and become absolute. Mistakes and unknown keys go to the node's log under the recipe's key.
void read_section(RecipeNode& node, const std::string& name, const std::string& project_key, Project& project);

// "settings": {KEY: VALUE} for all projects; a list of KEY=VALUE as --set takes them, put into the project too.
[[nodiscard]] std::vector<std::string> read_settings(RecipeNode& recipe, Project& base);

// Adds KEY=VALUE from the command line to the list and to the project. What is wrong is logged as kind usage.
void add_settings(const std::vector<std::string>& more, std::vector<std::string>& settings, Project& base,
                  RecipeLog& log);

// Puts KEY=VALUE that add_settings() has taken over what a background says of itself.
void apply_settings(const std::vector<std::string>& settings, Project& project);

// Warns of the recipe's settings of camera and light that each of its backgrounds says otherwise.
void warn_of_overridden(RecipeNode& recipe);

}  // namespace sigs
