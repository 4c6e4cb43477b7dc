// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "accuracy/csv.h"
#include "base/image.h"
#include "comparison/inserted_target.h"
#include "frame/composed_frame.h"
#include "realism/clips.h"
#include "realism/look_settings.h"
#include "scene/scene_files.h"
#include "video/frame.h"

namespace sigs::bench {

// One target that was measured.
struct Target : MeasuredTarget {
  std::string kind;  // "real", "moved" (the real one, in another place of the same frame), or the settings' name

  Target(std::string kind_of_it, MeasuredTarget target)
      : MeasuredTarget(std::move(target)), kind(std::move(kind_of_it)) {}
};

// The targets of one frame: a real one and those put beside it. Those that could not be told from the background are
// missing.
struct Sample {
  std::string clip;
  bool is_helicopter = false, is_tuning = false;
  int frame = 0;                // of a still: which of the insertions
  std::string model;            // of the inserted ones
  std::vector<Target> targets;  // the real one first
};

struct SampleOptions {
  std::filesystem::path folder;        // for calibrations
  std::vector<LookSettings> settings;  // one inserted target for each
  int frames_per_clip = 6;
  int views = 1;       // of each sample, of which the one with the area most like the real target's is taken
  bool steps = false;  // trackers: what is made equal to the real target is added step by step
};

// Why frames of a clip gave no sample.
struct LeftOut {
  int not_found = 0;  // the real target does not differ from its background
  int cut = 0;        // ... or goes on beyond its box: a condensation trail, or an object behind it
  int no_place = 0;   // there is no other place of its size
};

// What a thread keeps from clip to clip.
struct Workplace {
  ComposeContext context;
  SceneFiles files;
};

// The project of a clip: an aircraft of the clip's kind, the same in all its frames, a pinhole of 60 degrees.
[[nodiscard]] Project project_of(const RealClip& clip, cv::Size size_px, const std::filesystem::path& folder);

// The models to choose from, ours first. Those of FlightGear may be missing from the disk.
[[nodiscard]] std::vector<ModelSettings> models_of(bool is_helicopter);

// Seed of a sample: the same whatever else is measured.
[[nodiscard]] std::uint32_t seed_of(const std::string& text, int frame);

// Stops the program where there is an error.
template <class Value>
[[nodiscard]] Value expected(Result<Value> result) {
  if (!result) accuracy::stop(result.error().text());
  return *std::move(result);
}

// Evenly spread frames of a clip, each with the three before and after it.
[[nodiscard]] std::vector<Sample> samples_of(const RealClip& clip, const SampleOptions& options, Workplace& workplace,
                                             LeftOut& left_out);

// The frame with a copy of the target that a loose box holds, moved by whole pixels (an even number both ways). What
// the target and the codec's traces within 10 px of it differ from the background there is put onto the background at
// the new place, with a soft edge; so the copy brings its own noise. A limit of what insertion can reach.
// None where target_silhouette() finds no target, or the copy would not lie within the frame.
[[nodiscard]] std::optional<Frame> with_target_moved(const Frame& frame, const Box& box, cv::Point shift);

}  // namespace sigs::bench
