// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "appearance/codec.h"
#include "appearance/estimate.h"
#include "appearance/glare.h"
#include "appearance/light_image.h"
#include "appearance/noise.h"
#include "appearance/point_spread.h"
#include "appearance/surroundings.h"
#include "appearance/thermal_look.h"
#include "base/result.h"
#include "project/project.h"
#include "scene/scene.h"
#include "video/frame_source.h"

namespace sigs {

// Which frames are looked at.
struct AppearanceFrames {
  int first = 0;
  std::optional<int> last;  // included; none: the footage's last
  int every = 0;  // each so many frames one is used, with the frame after it; 0: 24 are, spread over the range
};

// What is known besides the footage. All of it may be missing.
struct AppearanceHints {
  std::function<View(int frame)> view;  // of the camera at a frame; empty: nothing is known
  // Unit vector, by time and place; empty: the project does not know them.
  std::function<glm::dvec3(int frame)> to_sun_in_world;
  bool is_thermal = false;                  // footage of a thermal camera: its levels are looked for too
  HeatPalette palette = HeatPalette::gray;  // of its colours: what is looked at is the heat that they show
};

struct AppearanceControl {
  std::function<void(int done, int total)> progress;  // frames; called on the calling thread
  const std::atomic<bool>* cancel = nullptr;          // set to true: ends soon with the error `interrupted`
  std::function<void(const Warning&)> warn;           // of the files that are read; may be empty
};

// How footage looks. Each estimator has a class in a header of its own; add its findings here, call it in
// `Estimators` of appearance.cpp, list its quantities in quantities_of() and its settings in apply().
struct Appearance {
  VideoInfo footage;
  int frames_used = 0;
  PointSpreadFound point_spread;
  NoiseFound noise;
  SurroundingsEstimate surroundings;     // haze, tone, light, sun
  std::optional<LevelsEstimate> levels;  // of thermal footage
  std::optional<GlareFound> glare;       // of dark footage
  ToneHistogram tone_histogram{};
  HazeCurve haze_curve;
  CodecEstimate codec;
};

// Looks at the footage once, from its first frame used to the last; decoding runs ahead on a thread of its own, and two
// threads look at each frame. Damaged frames are left out. The footage should have been opened with Quantisers::read.
// What cannot be told says so (Estimate) and is no error. Errors: usage (no such frames), cannot_read, bad_data,
// interrupted.
[[nodiscard]] Result<Appearance> estimate_appearance(FrameSource& footage, const AppearanceFrames& frames,
                                                     const AppearanceHints& hints, const AppearanceControl& control);

// One quantity of the list that users see.
struct AppearanceQuantity {
  std::string name;  // "point spread"
  std::string unit;  // may be empty
  Estimate estimate;
  std::string setting;  // key of the project's setting that takes it; empty: none does
  std::string how;      // what it was found by, where that may be one of several things: "by time and place"
};
[[nodiscard]] std::vector<AppearanceQuantity> quantities_of(const Appearance& appearance);

// A line for people: "45 +- 1 deg, by time and place", or why it is not known and what is taken.
[[nodiscard]] std::string text_of(const AppearanceQuantity& quantity);

// Drawings that show why.
[[nodiscard]] std::vector<Panel> panels_of(const Appearance& appearance);

// Makes intruders look like the footage: sets `appearance` and, where it was found, `light` of a project, and switches
// off compositing.blur_px_per_m, the paper's blur, in place of which the point spread stands. What is not known gets
// its estimate's default. Values are rounded to three digits and held in their settings' ranges. The grain's seed
// stays. So do, of a thermal project, light, black and haze, and a blur or a sky's code that the footage does not show.
void apply(const Appearance& appearance, Project& project);

// The keys of the settings that apply() writes, in the order of the project file.
[[nodiscard]] std::vector<std::string> applied_settings(const Appearance& appearance);

// The names of the quantities with a setting that the footage does not tell, so that the setting has its default or
// stays: "point spread". The parts of a colour are named once.
[[nodiscard]] std::vector<std::string> names_of_unknown(const Appearance& appearance);

// What a project knows of its camera at each frame, for estimate_appearance(): the calibration, attitude and height
// where they are stated, the own body's mask, the sun's direction where the camera's log has UTC and place. Intruders
// and their models are not looked at, and may be missing. Errors name the project file and the field.
//   height_is_guess  the camera's height in the project was guessed (is_still_guessed() in first_project), and counts
//                    as not known
//   warn             called with each warning of the files that are read
[[nodiscard]] Result<AppearanceHints> hints_of(const Project& project, const VideoInfo& footage, bool height_is_guess,
                                               const std::function<void(const Warning&)>& warn);

// The same by a scene of which no project file is written yet: its camera, its attitude where that is known, and the
// sun by time and place. The height counts as not known: that of a project which is being made is a guess.
[[nodiscard]] AppearanceHints hints_of(const Scene& scene);

// How the footage of a project looks: opens it, and estimates with what the project knows of its camera. Errors: those
// of open_footage(), hints_of() and estimate_appearance().
[[nodiscard]] Result<Appearance> appearance_of_footage(const Project& project, const AppearanceFrames& frames,
                                                       bool height_is_guess, const AppearanceControl& control);

}  // namespace sigs
