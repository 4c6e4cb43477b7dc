// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "base/result.h"
#include "project/project.h"

namespace sigs {

// A number that is fixed, or drawn anew for each video. docs/dataset.md has how each is written.
struct Quantity {
  enum class Kind { fixed, uniform, normal, choice };
  Kind kind = Kind::fixed;
  double value = 0;                // fixed
  double low = 0, high = 0;        // uniform: [low, high); normal: bounds, within which it is drawn
  double mean = 0, deviation = 0;  // normal
  std::vector<double> choices;     // choice: each as likely
};

// Footage that videos may use. Paths are relative to the recipe's file.
struct Background {
  std::string name;
  FootageSettings footage;
  CameraSettings camera;
  LightSettings light;
  std::map<std::string, std::string> tags;
};

struct Aircraft {
  std::string name;
  std::string category = "airplane";
  ModelSettings model;
};

// How one intruder flies: one of the paper's four ways, or an encounter.
enum class FlightKind { left_right, right_left, approaching, moving_away, encounter };

struct FlightPlan {
  std::string name;  // what names of videos call it
  FlightKind kind = FlightKind::left_right;
  // Which of these a kind reads, and their defaults: docs/dataset.md.
  std::map<std::string, Quantity> quantities;  // "miss_distance_m", "closing_speed_mps", "bearing_deg", ...
};

// A group of videos: every combination of its backgrounds, aircraft and flights, `count` times each.
struct VideoGroup {
  std::string name;  // pattern: {background} {aircraft} {flight} {number}
  std::vector<std::string> backgrounds;
  std::vector<std::string> aircraft;
  std::vector<FlightPlan> flights;
  int count = 1;
  std::optional<int> frames;  // length; none: what the background has
  int first_frame = 0;        // of the background
  std::string split;          // fixed; empty: drawn
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
  std::vector<std::string> settings;  // KEY=VALUE for every project, as --set takes them
  std::vector<Background> backgrounds;
  std::vector<Aircraft> aircraft;
  std::vector<VideoGroup> groups;
  std::vector<SplitShare> splits;  // shares add up to 1
  std::string keep_together;       // videos that agree in it share a split: "background", "aircraft" or empty
  std::string text;                // the file as it is
};

// Errors bad_data name the file and the key.
struct ReadRecipe {
  Recipe recipe;
  std::vector<Warning> warnings;  // unknown keys
};
[[nodiscard]] Result<ReadRecipe> read_recipe(const std::filesystem::path& path);

}  // namespace sigs
