// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

#include "base/json.h"

namespace sigs {

// Changes the relative paths in the JSON of a recipe, which start in its folder, so that they name the same files from
// another one: of backgrounds, aircraft, flights and settings. What has another form than a recipe stays as it is.
//   from, to  the recipe's file, and the one that it is to be written to
void move_recipe_paths(Json& recipe, const std::filesystem::path& from, const std::filesystem::path& to);

}  // namespace sigs
