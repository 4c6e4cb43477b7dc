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

namespace sigs::cli {

// What `sigs evaluate track` was asked for.
struct TrackRequest {
  // A project or, by its name, a label file.
  ProjectOptions input;
  // Names of OpenCV's trackers that are to run; may be empty.
  std::vector<std::string> trackers;
  // Files with results of other trackers, and their format.
  std::vector<std::filesystem::path> results;
  ResultsFormat format = ResultsFormat::automatic;
  // Index of the intruder that is followed; none: the only one.
  std::optional<int> intruder;
  TrackPolicy policy;
  // Trackers start in the first frame in which the visible box has sides of at least this length.
  double min_side_px = kMinSide_px;
  // The images of a label file; empty: what lies beside the labels.
  std::filesystem::path video;
  // Of a project, in place of its own range.
  std::optional<FrameRange> frames;
  // Frames composed in parallel.
  int jobs = 1;
  std::string progress = "auto";
};

// A clip whose trackers have run.
struct TrackedClip {
  std::string name;
  ClipTruth truth;
  // Index in truth.targets of the intruder that is followed.
  int target = 0;
  TrackPolicy policy;  // as asked for, from the frame where trackers start
  std::vector<Results> results;
  std::vector<std::string> remarks;
};

// Runs the trackers asked for on what the input shows, in one pass; where there are none, makes or reads the truth
// alone. Errors: what is wrong with the input, an intruder that can nowhere be followed, trackers of which none could
// be started.
[[nodiscard]] Result<TrackedClip> tracked_clip(const TrackRequest& request);

}  // namespace sigs::cli
