// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <functional>
#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <vector>

#include "base/result.h"
#include "cli/options.h"
#include "evaluation/metrics/track_score.h"
#include "evaluation/opencv_tracker.h"
#include "evaluation/readers/clip_truth.h"
#include "evaluation/readers/results.h"
#include "video/frame_source.h"

namespace sigs::cli {

// How the images of a folder are called: frame_000123.png by the footage's number, as SIGS writes them; or anything, in
// order of the numbers at the end of their names.
enum class ImageNames { by_frame, in_order };

// The images that labels belong to: an exported video, or a folder of images.
class LabelledImages {
 public:
  // Beside NAME.xml: NAME.mkv, .mp4, .avi or the folder NAME. Error cannot_read: there is none, or more than one.
  [[nodiscard]] static Result<std::filesystem::path> beside(const std::filesystem::path& labels);

  // Error bad_data where number or size of the images are not those of the labels. A size that the labels do not state
  // is not compared.
  [[nodiscard]] static Result<LabelledImages> open(const std::filesystem::path& path, const ClipTruth& clip,
                                                   ImageNames names = ImageNames::by_frame);

  // The image of a frame, by the footage's number; CV_8UC3, BGR.
  [[nodiscard]] Result<cv::Mat> at(int frame);

 private:
  LabelledImages(std::filesystem::path path, FootageTruth footage) : path_(std::move(path)), footage_(footage) {}

  std::filesystem::path path_;
  FootageTruth footage_;
  std::vector<std::filesystem::path> files_;  // of a folder, one for each frame
  std::optional<FrameSource> video_;          // none: path_ is a folder
};

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
