// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <string>
#include <vector>

#include "dataset/recipe.h"
#include "dataset/recipe_node.h"

namespace sigs {

// A group's "light": { ... } or a list of them, each with "position_m", "color" (three quantities each) and "ambient"
// (one), of which any may be left out. What `settings` (KEY=VALUE of the command line) say wins, so it is left out
// here. Values that a project may not have are mistakes; these go to the node's log.
[[nodiscard]] std::vector<LightPlan> read_lights(RecipeNode& group, const std::vector<std::string>& settings);

// The light with the numbers that were sampled for it: "light_x_m", ...; the rest stays.
[[nodiscard]] LightSettings with_sampled_light(LightSettings light, const std::map<std::string, double>& sampled);

}  // namespace sigs
