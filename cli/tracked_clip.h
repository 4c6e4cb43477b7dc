// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/result.h"
#include "cli/options.h"
#include "evaluation/results.h"
#include "evaluation/track_score.h"
#include "options.h"

namespace sigs::cli {

// What `sigs evaluate track` was asked for.
struct TrackRequest {
  ProjectOptions input;  // a project or, by its name, a label file
  std::vector<std::string> trackers;
  std::vector<std::filesystem::path> results;
  ResultsFormat format = ResultsFormat::automatic;
  std::optional<int> intruder;
  TrackPolicy policy;
  double min_side_px = kMinSide_px;
  std::filesystem::path video;  // empty: what lies beside the labels
  std::optional<FrameRange> frames;
  int jobs = 1;
  std::string progress = "auto";
};

// A clip whose trackers have run.
struct TrackedClip {
  std::string name;
  ClipTruth truth;
  int target = 0;      // place in truth.targets
  TrackPolicy policy;  // as asked for, from the frame where trackers start
  std::vector<Results> results;
  std::vector<std::string> remarks;
};

// Runs the trackers asked for on what the input shows, in one pass; where there are none, makes or reads the truth
// alone. Errors: what is wrong with the input, an intruder that can nowhere be followed, trackers of which none could
// be started.
[[nodiscard]] Result<TrackedClip> tracked_clip(const TrackRequest& request);

}  // namespace sigs::cli
