// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <string>
#include <vector>

#include "base/result.h"
#include "dataset/recipe.h"
#include "project/project.h"

namespace sigs {

// One video of a dataset, ready to be exported.
struct PlannedVideo {
  std::string name;  // unique in the plan; the project's too
  Project project;   // its paths are absolute
  std::string split;
  std::map<std::string, std::string> tags;  // background, aircraft, flight and those of the recipe
  std::map<std::string, double> drawn;      // what was drawn or fixed for it: "miss_distance_m", ...
};

// A video that cannot be: the intruder under the ground, a closing speed that cannot meet the miss distance, ...
struct ImpossibleVideo {
  std::string name;
  std::string why;  // one line that names the quantity
};

// A video whose background cannot be opened; once that is mended it can be.
struct UnopenedVideo {
  std::string name;
  Error error;  // names recipe and key
};

struct Plan {
  std::string name;                  // the dataset's
  std::vector<PlannedVideo> videos;  // in the recipe's order
  std::vector<ImpossibleVideo> impossible;
  std::vector<UnopenedVideo> unopened;
};

// Expands a recipe. Draws depend on seed, video and quantity alone: not on order, nor on how many videos there are.
// Opens the footage that the recipe names, to know its length; where a
// clip cannot be opened its videos are `unopened`, where none can it is an error. Errors: what is wrong with the
// recipe as a whole.
[[nodiscard]] Result<Plan> plan_of(const Recipe& recipe);

}  // namespace sigs
