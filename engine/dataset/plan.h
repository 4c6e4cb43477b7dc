// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
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
  std::map<std::string, double> sampled;    // what was sampled or fixed for it: "miss_distance_m", ...
  std::map<std::string, int> resamples;     // how often it was sampled anew, by what stood against the sample
};

// A video that cannot be: the intruder under the ground, a closing speed that cannot meet the miss distance, ...
struct ImpossibleVideo {
  std::string name;
  std::string why;  // one line that names the quantity
};

// A video whose background cannot be opened; once that is repaired it can be.
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

// Expands a recipe. Samples depend on seed, video and quantity alone: not on order, nor on how many videos there are.
// Opens the footage that the recipe names, to know its length; where a
// clip cannot be opened its videos are `unopened`, where none can it is an error. A video that cannot be flown or is
// never seen is sampled anew, as often as its group allows; one that is not made after that is impossible, with what
// stood against it and how often. Errors: what is wrong with the recipe as a whole; interrupted.
[[nodiscard]] Result<Plan> plan_of(const Recipe& recipe, const std::atomic<bool>* cancel = nullptr);

// Of several videos together.
[[nodiscard]] std::map<std::string, int> resamples_of(const std::vector<const PlannedVideo*>& videos);

// "never in the picture 4 times; speed_mps once"; the most frequent one first.
[[nodiscard]] std::string resamples_text(const std::map<std::string, int>& resamples);

}  // namespace sigs
