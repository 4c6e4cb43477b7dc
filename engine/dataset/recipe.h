// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/result.h"
#include "dataset/flight_quantities.h"
#include "dataset/sample.h"
#include "encounter_model/encounter_model.h"
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

// A flight that something flew, as recorded.
struct FlownTrack {
  std::string name;                      // callsign, address or name in the file; may be empty
  std::vector<double> times_s;           // from the first point, which is at 0; rising strictly; at least two
  std::vector<glm::dvec3> places_ned_m;  // one for each time: north, east, down, from wherever the recording began

  [[nodiscard]] double length_s() const { return times_s.back(); }
};

// All flights with times that a file has: whatever geo/recorded_path.h (GPX, KML, ADS-B), telemetry/track.h (logs
// of aircraft, CSV) or encounter/daa_file.h (.daa, CSV of pairs) reads, by the content. Heights are taken as they are.
// Errors: cannot_read; bad_data: none of these formats, or no flight of two points with times in it.
struct ReadFlights {
  std::vector<FlownTrack> tracks;
  std::vector<Warning> warnings;
};
[[nodiscard]] Result<ReadFlights> read_flown_tracks(const std::filesystem::path& file);

// What a flight is taken from that is not made of quantities alone: recordings, and statistics of recordings.
struct FlightSource {
  std::optional<EncounterModel> model;      // of kind encounter_model
  std::optional<EncounterModel> own_model;  // likewise; none: the ownship flies as the camera does
  std::vector<FlownTrack> tracks;           // of kind recorded; one of them is sampled
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

// What the name of a video is made of.
struct NameParts {
  std::string background;
  std::string aircraft;
  std::string flight;
  int number = 1;  // from 1, among the videos of a group whose names differ by it alone
};

// The pattern with {background}, {aircraft}, {flight} and {number} filled in. Numbers have at least four digits, so
// that names sort, and adding videos renames none.
[[nodiscard]] std::string name_from(const std::string& pattern, const NameParts& parts);

// What is wrong with a pattern, as "has no such part: {plane}". Empty: nothing.
[[nodiscard]] std::string wrong_with_pattern(const std::string& pattern);

// What is wrong with the name of a video, which becomes that of a folder: what file_name_error() says, or that the
// name belongs to a file of the dataset itself. Empty: nothing.
[[nodiscard]] std::string wrong_with_video_name(const std::string& name);

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
