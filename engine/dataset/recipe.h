// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/result.h"
#include "dataset/flight_quantities.h"
#include "dataset/sample.h"
#include "project/project.h"

namespace sigs {

// Footage that videos may use, with the camera that took it and its light. Paths are absolute.
struct Background {
  std::string name;
  FootageSettings footage;  // first and last frame: the part that may be used
  CameraSettings camera;
  LightSettings light;
  std::map<std::string, std::string> tags;
};

struct Aircraft {
  std::string name;
  std::string category = "airplane";
  ModelSettings model;                   // its path is absolute
  std::optional<Span> speed_limits_mps;  // over ground; none: it flies as fast as a flight asks for
  std::map<std::string, std::string> tags;
};

struct FlightPlan {
  std::string name;  // what names of videos call it
  FlightKind kind = FlightKind::left_right;
  std::map<std::string, Quantity> quantities;  // those that the recipe gives: dataset/flight_quantities.h
};

// What a group says of the light: numbers that stand in for the background's ("light_x_m", ..., light_draw.h).
struct LightPlan {
  std::map<std::string, Quantity> quantities;
};

// A group of videos: every combination of its backgrounds, aircraft and flights, `count` times each; or `count` videos
// whose background, aircraft and flight are sampled.
struct VideoGroup {
  std::string name;  // pattern: {background} {aircraft} {flight} {number}
  std::vector<std::string> backgrounds;
  std::vector<std::string> aircraft;
  std::vector<FlightPlan> flights;
  bool is_sampled = false;
  int count = 1;
  std::optional<int> resamples;  // how often at most a video that cannot be flown or is never seen is sampled anew;
                                 // none: it is sampled once, and made though it is never seen
  std::vector<LightPlan> lights;  // one of them is sampled; empty: the background's light
  std::optional<int> frames;      // length; none: to the end of what the background has
  Quantity first_frame;           // counted from the background's first one; the whole part is taken
  std::string split;              // fixed; empty: sampled
  std::map<std::string, std::string> tags;
};

struct SplitShare {
  std::string name;  // "train"
  double share = 0;
};

struct Recipe {
  std::filesystem::path file;
  std::string name;
  std::uint64_t seed = 0;
  std::vector<std::string> settings;  // KEY=VALUE for every project, as --set takes them; later ones count
  Project base;                       // a project that has them, with one intruder; all videos start from it
  std::vector<Background> backgrounds;
  std::vector<Aircraft> aircraft;
  std::vector<VideoGroup> groups;
  std::vector<SplitShare> splits;  // shares add up to 1; none: videos without a split of their own have none
  std::string keep_together;       // a tag: videos that agree in it share a split; empty: none
  std::string text;                // the file as it is
};

// Every name that is used is there, every number has the form it should; whether a flight can be flown is plan.h's
// business. Errors name the file and the key: cannot_read where a file is not there, else bad_data.
struct ReadRecipe {
  Recipe recipe;
  std::vector<Warning> warnings;  // unknown keys, settings without effect
};
// settings: KEY=VALUE that win over all that the recipe says, as --set gives them; what is wrong with them is kind
// usage.
[[nodiscard]] Result<ReadRecipe> read_recipe(const std::filesystem::path& path,
                                             const std::vector<std::string>& settings = {});

// The same from text; path stands for the file in messages and for relative paths.
[[nodiscard]] Result<ReadRecipe> parse_recipe(const std::string& text, const std::filesystem::path& path,
                                              const std::vector<std::string>& settings = {});

}  // namespace sigs
