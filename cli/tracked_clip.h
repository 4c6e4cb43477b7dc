// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "base/result.h"
#include "cli/labelled_images.h"
#include "cli/options.h"
#include "evaluation/metrics/track_score.h"
#include "evaluation/opencv_tracker.h"
#include "evaluation/readers/results.h"

namespace sigs::cli {

// What `sigs evaluate track` was asked for.
struct TrackRequest {
  // A project or, by its name, a label file, or the folder of an otb or vot sequence.
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

// Labels that trackers can be run on.
struct TrackInput {
  std::string name;
  // NAME.xml, or the folder of a sequence.
  std::filesystem::path labels;
  ClipTruth truth;
  // Empty: beside NAME.xml, if images are wanted.
  std::filesystem::path images;
  ImageNames image_names = ImageNames::by_frame;
};

// Is told, after each image, how many of how many are done. false: stop, with the error interrupted.
using FrameCounter = std::function<bool(int done, int total)>;

// Reads the truth of NAME.xml or of an otb or vot folder. Errors: as the readers; settings that go with a project.
[[nodiscard]] Result<TrackInput> read_track_input(const TrackRequest& request, const std::filesystem::path& path);

// The policy of a target of the input with the frame in which trackers start; nullopt: they cannot be started.
[[nodiscard]] std::optional<TrackPolicy> started_policy(const TrackRequest& request, const TrackInput& input,
                                                        int target);

// Runs trackers on one target. Those that cannot be started are missing in the results. Errors: nothing to follow,
// images that do not fit the truth, interrupted.
[[nodiscard]] Result<TrackedClip> tracked_input(const TrackRequest& request, const TrackInput& input, int target,
                                                TrackerGroup group, const FrameCounter& on_frame);

// Runs the trackers asked for on what the input shows, in one pass; where there are none, makes or reads the truth
// alone. Errors: what is wrong with the input, an intruder that can nowhere be followed, trackers of which none could
// be started.
[[nodiscard]] Result<TrackedClip> tracked_clip(const TrackRequest& request);

}  // namespace sigs::cli
