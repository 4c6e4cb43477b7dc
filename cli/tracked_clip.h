// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "base/result.h"
#include "cli/options.h"
#include "evaluation/metrics/track_score.h"
#include "evaluation/opencv_tracker.h"
#include "evaluation/readers/clip_truth.h"
#include "evaluation/readers/results.h"

namespace sigs::cli {

// How the images of a folder are called: frame_000123.png by the footage's number, as SIGS writes them; or anything, in
// order of the numbers at the end of their names.
enum class ImageNames { by_frame, in_order };

// What `sigs evaluate track` was asked for.
struct TrackRequest {
  ProjectOptions input;  // a project or, by its name, a label file, or the folder of an otb or vot sequence
  std::vector<std::string> trackers;           // names of OpenCV's trackers that are to run; may be empty
  std::vector<std::filesystem::path> results;  // files with results of other trackers, in this format
  ResultsFormat format = ResultsFormat::automatic;
  std::optional<int> intruder;  // index of the one that is followed; none: the only one
  TrackPolicy policy;
  // Trackers start in the first frame in which the visible box has sides of at least this length.
  double min_side_px = kMinSide_px;
  std::filesystem::path video;       // the images of a label file; empty: what lies beside the labels
  std::optional<FrameRange> frames;  // of a project, in place of its own range
  int jobs = 1;                      // frames composed in parallel
  std::string progress = "auto";
};

// A clip whose trackers have run.
struct TrackedClip {
  std::string name;
  ClipTruth truth;
  int target = 0;      // index in truth.targets of the intruder that is followed
  TrackPolicy policy;  // as asked for, from the frame where trackers start
  std::vector<Results> results;
  std::vector<std::string> remarks;
};

// Labels that trackers can be run on.
struct TrackInput {
  std::string name;
  std::filesystem::path labels;  // NAME.xml, or the folder of a sequence
  ClipTruth truth;
  std::filesystem::path images;  // empty: beside NAME.xml, if images are wanted
  ImageNames image_names = ImageNames::by_frame;
};

// Is told, after each image, how many of how many are done. false: stop, with the error interrupted.
using FrameCounter = std::function<bool(int done, int total)>;

// Reads the truth of NAME.xml or of an otb or vot folder. Errors: as the readers; settings that go with a project.
[[nodiscard]] Result<TrackInput> read_track_input(const TrackRequest& request, const std::filesystem::path& path);

// The policy of a target with the frame in which trackers start; nullopt: they cannot be started.
[[nodiscard]] std::optional<TrackPolicy> started_policy(const TrackRequest& request, const ClipTruth& truth,
                                                        int target);

// Runs trackers on one target. Those that cannot be started are missing in the results. Errors: nothing to follow,
// images that do not fit the truth, interrupted.
[[nodiscard]] Result<TrackedClip> tracked_input(const TrackRequest& request, const TrackInput& input, int target,
                                                TrackerGroup group, const FrameCounter& on_frame);

// Runs the trackers asked for on what the input shows, in one pass; where there are none, makes or reads the truth
// alone. Errors: what is wrong with the input, an intruder that can nowhere be followed, trackers of which none could
// be started.
[[nodiscard]] Result<TrackedClip> tracked_clip(const TrackRequest& request);

// Whether the path is a folder of many clips: a dataset, or a folder of otb or vot sequences.
[[nodiscard]] bool is_track_set(const std::filesystem::path& path);

// `sigs evaluate track` on many clips, request.jobs of them side by side: prints the figures and writes the report
// where a folder is named.
//   request  input.file is the folder; results are folders, one for each tracker, with a file for each clip
//   split    only these clips of a dataset; empty: all
// Errors: of a clip that comes first in their order, whatever the number of jobs; interrupted. Nothing is written then.
[[nodiscard]] Result<void> evaluate_track_set(const TrackRequest& request, const std::string& split,
                                              const std::filesystem::path& folder, bool force);

}  // namespace sigs::cli
