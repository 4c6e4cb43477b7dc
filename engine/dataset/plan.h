// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "base/result.h"
#include "dataset/matched_look.h"
#include "dataset/recipe.h"
#include "project/project.h"

namespace sigs {

// One video of a dataset, ready to be exported.
struct PlannedVideo {
  std::string name;  // unique in the plan; the project's too
  Project project;   // its paths are absolute
  // Of one of several cameras of an aircraft, whose videos follow one another: the project of all of them, of which
  // `project` is what this camera sees. The name is that of the whole, a dot and the camera's.
  std::optional<Project> rig = {};
  std::string split;
  std::map<std::string, std::string> tags;  // background, aircraft, flight and those of the recipe
  std::map<std::string, double> sampled;    // what was sampled or fixed for it: "miss_distance_m", ...
  std::map<std::string, int> resamples;     // how often it was sampled again, by the reason
  std::optional<std::size_t> clip = {};     // its footage's look is to be measured: place in Plan::clips
  std::set<std::string> stated = {};        // with `clip`: settings that the measured look does not replace
  std::optional<MeasuredLook> look = {};    // what was measured, and is in the project
};

// A video for which there is no flight: the intruder is underground, the closing speed does not fit the miss distance,
// ...
struct ImpossibleVideo {
  std::string name;
  std::string why;  // one line that names the quantity
};

struct VideoFailure {
  std::string video;
  Error error;
};

struct Plan {
  std::string name;                  // the dataset's
  std::vector<PlannedVideo> videos;  // in the recipe's order
  std::vector<ImpossibleVideo> impossible;
  std::vector<VideoFailure> unopened;     // their backgrounds cannot be opened; errors name recipe and key
  std::vector<ClipToMeasure> clips = {};  // whose look the run measures before it makes videos of them
};

// Makes the plan of a recipe. Samples depend on seed, video and quantity alone, not on the order or number of videos.
// Opens the footage that the recipe names, to know its length: where a clip cannot be opened its videos are `unopened`,
// where no clip can it is an error. A video that cannot be flown, or whose intruder is never in the image, is sampled
// again as often as its group allows; after that it is impossible, with all reasons and their numbers. Errors: what is
// wrong with the recipe as a whole; interrupted.
[[nodiscard]] Result<Plan> plan_of(const Recipe& recipe, const std::atomic<bool>* cancel = nullptr);

// The numbers of several videos added up.
[[nodiscard]] std::map<std::string, int> resamples_of(const std::vector<const PlannedVideo*>& videos);

// "never in the picture 4 times; speed_mps once", the most frequent reason first. These words are written into index
// files.
[[nodiscard]] std::string resamples_text(const std::map<std::string, int>& resamples);

// The properties of a video that determine its split.
struct SplitCandidate {
  std::string video;
  std::string fixed;  // the split that its group names; empty: it is assigned
  std::string unit;   // candidates of one unit get the same split; empty: a unit of its own
};

// The split of each candidate. A unit with a fixed member gets that member's split. The others are sorted by size, the
// largest first, and by a hash of seed and name, and each in turn goes to the split that is farthest below its share of
// the videos; for units of one size that is the method of the largest remainder. Without shares, units without a fixed
// member get "". Error bad_data, with an empty place: one unit has two fixed splits.
[[nodiscard]] Result<std::vector<std::string>> splits_of(std::span<const SplitCandidate> candidates,
                                                         std::span<const SplitShare> shares, std::uint64_t seed);

}  // namespace sigs
