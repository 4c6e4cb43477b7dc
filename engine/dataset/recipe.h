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
#include "dataset/flown_track.h"
#include "dataset/sample.h"
#include "project/project.h"

namespace sigs {

// A recipe as values. Reading it checks every key and every name; whether a flight can be flown is checked when the
// plan is made (plan.h).

// Footage that videos may use, with its camera, its light and how it looks. Paths are absolute.
struct Background {
  std::string name;
  FootageSettings footage;  // first and last frame limit the part that may be used; of several cameras the first one's
  std::vector<RigCamera> cameras = {};  // of an aircraft with several; empty: one camera
  CameraSettings camera;
  LightSettings light;
  AppearanceSettings appearance;
  bool is_matched = false;          // appearance and light are measured in the footage (matched_look.h), but for ...
  std::vector<std::string> stated;  // ... these settings, which the recipe states: "light.exposure"
  bool height_is_guess = false;     // of a matched one: the camera's height was guessed by `sigs init`
  std::map<std::string, std::string> tags;
};

struct Aircraft {
  std::string name;
  std::string category = "airplane";
  ModelSettings model;                       // its path is absolute
  std::vector<std::string> liveries;         // models of the same shape, absolute; one is sampled; empty: `model` alone
  Quantity scale{.value = 1};                // factor of the model's size
  bool is_distractor = false;                // what detectors should not report, such as a bird
  std::optional<Span> speed_limits_mps;      // over ground; none: any speed is allowed
  std::map<std::string, Quantity> contrail;  // numbers of the project, by key: "intruders[0].contrail.strands"
  double contrail_above_m = 0;               // only this far above the ground, z = 0
  std::map<std::string, Quantity> drawn;     // likewise, of heat and lights: "intruders[0].heat.skin"
  std::map<std::string, std::string> tags;
};

struct FlightPlan {
  std::string name;  // used in names of videos
  FlightKind kind = FlightKind::left_right;
  std::map<std::string, Quantity> quantities;  // those that the recipe gives; names: flight_quantities.h
  FlightSource source;                         // of the kinds encounter_model and recorded
};

// Numbers of the light that a group of videos samples in place of the background's: "light_x_m", "light_y_m",
// "light_z_m", "light_red", "light_green", "light_blue" and "light_ambient", as far as the recipe gives them.
struct LightPlan {
  std::map<std::string, Quantity> quantities;
  std::map<std::string, Quantity> numbers;  // of the project, by key: "light.sun.azimuth_deg"
};

// The light with the sampled numbers in it; those that were not sampled stay.
[[nodiscard]] LightSettings with_sampled_light(LightSettings light, const std::map<std::string, double>& sampled);

// The key of the setting that such a number is of: "light.position_m" of "light_x_m".
[[nodiscard]] std::string setting_of_light(const std::string& name);

// What else flies in the videos of a group: a sampled number of bodies, each of a sampled aircraft and flight.
struct OthersPlan {
  Quantity count{.value = 1};         // rounded down, 0 to kMaxOthers
  std::vector<std::string> aircraft;  // names, at least one
  std::vector<FlightPlan> flights;
};
inline constexpr int kMaxOthers = 100;

// What is behind an aircraft that is placed in an image, by what the image shows there (horizon/sky_map.h).
enum class Placement { anywhere, sky, land };

// A group of videos: every combination of its backgrounds, aircraft and flights, `count` times each; or, where
// is_sampled, `count` videos whose background, aircraft and flight are sampled.
struct VideoGroup {
  std::string name;  // pattern: {background} {aircraft} {flight} {number}
  std::vector<std::string> backgrounds;
  std::vector<std::string> aircraft;
  std::vector<FlightPlan> flights;
  bool is_sampled = false;
  int count = 1;
  bool is_images = false;  // sampled videos of one frame each, any of the background's; flights are image_position
  Quantity per_image{.value = 1};             // of images: how many aircraft each shows, 0 to kMaxOthers; rounded down
  Placement placement = Placement::anywhere;  // of images
  // How often at most a video that cannot be flown, or whose intruder is never in the image, is sampled again; none: it
  // is sampled once, visible or not.
  std::optional<int> resamples;
  std::vector<LightPlan> lights;            // one of them is sampled; empty: the background's light
  std::map<std::string, Quantity> numbers;  // of the project, by key: "appearance.haze.visibility_m"
  std::vector<OthersPlan> others;
  std::optional<int> frames;  // length in frames; none: to the last frame of the background
  std::optional<Quantity>
      first_frame;    // counted from the background's first one; rounded down. None: 0; of an image any
  std::string split;  // fixed; empty: sampled
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
  std::vector<std::string>
      settings;  // KEY=VALUE for every project, as set_field() takes them; later ones override earlier ones
  Project base;  // a project with these settings and one intruder; every video starts from it
  std::vector<Background> backgrounds;
  std::vector<Aircraft> aircraft;
  std::vector<VideoGroup> groups;
  std::vector<SplitShare> splits;  // shares add up to 1; none: videos without a split of their own have none
  std::string keep_together;       // a tag: videos that agree in it share a split; empty: none
  std::string text;                // the file as it is
};

struct ReadRecipe {
  Recipe recipe;
  std::vector<Warning> warnings;  // unknown keys, settings without effect
};

// settings: KEY=VALUE, as set_field() takes them, that override the recipe. An error in one of them names
// it and is of kind usage.
// Errors name the file and the key: cannot_read where a file is missing, else bad_data.
[[nodiscard]] Result<ReadRecipe> read_recipe(const std::filesystem::path& path,
                                             const std::vector<std::string>& settings = {});

// The same from text. path is the file's name in messages, and paths in the recipe are relative to its folder.
[[nodiscard]] Result<ReadRecipe> parse_recipe(const std::string& text, const std::filesystem::path& path,
                                              const std::vector<std::string>& settings = {});

}  // namespace sigs
