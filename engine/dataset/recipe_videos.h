// SPDX-License-Identifier: MIT
#pragma once

#include "dataset/recipe.h"
#include "dataset/recipe_node.h"

namespace sigs {

// The recipe's "videos" and "splits"; backgrounds and aircraft must have been read. Mistakes go to the node's log.
// settings: KEY=VALUE of the command line, which win over what a group says.
[[nodiscard]] std::vector<VideoGroup> read_groups(RecipeNode& recipe_node, const Recipe& recipe,
                                                  const std::vector<std::string>& settings);
void read_splits(RecipeNode& recipe_node, Recipe& recipe);

// Names that every video has of itself are no names for tags.
void check_tags(const std::map<std::string, std::string>& tags, RecipeNode& node);

}  // namespace sigs
