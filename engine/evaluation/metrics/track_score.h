// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "evaluation/metrics/slices.h"
#include "evaluation/readers/clip_truth.h"
#include "evaluation/readers/results.h"

namespace sigs {

// How well a tracker follows one intruder: the measures of the Online Tracking Benchmark (Wu, Lim, Yang, "Object
// tracking benchmark", 2015) per frame, and their figures. Boxes and centres are in pixels (base/image.h).
// docs/evaluation.md defines each figure.

// Which box of the truth a tracker is compared with: that of the visible pixels, or that of the whole intruder.
enum class TruthBox { visible, amodal };

// Which frames are scored, and against which box. docs/evaluation.md gives the reasons.
struct TrackPolicy {
  TruthBox truth = TruthBox::visible;
  int from_frame = 0;  // the footage's number; the tracker is started there, frames before it are not scored
  double min_visible_fraction = 0;  // frames in which less of the intruder is visible are not scored: hidden by the
                                    // own body, or outside the image
};

// The comparison in one frame.
struct FrameScore {
  int frame = 0;  // the footage's number
  double time_s = 0;
  bool is_scored = false;    // the truth has a box, and the policy counts the frame
  bool is_reported = false;  // the tracker reports a box
  // Reported minus true centre where both boxes exist; x to the right, y down. A centre is the middle of the edges; the
  // conventions x + w/2 and x + (w-1)/2 give the same difference.
  std::optional<double> dx_px;
  std::optional<double> dy_px;
  std::optional<double> center_error_px;   // CLE: length of (dx, dy)
  std::optional<double> normalized_error;  // length of (dx / true width, dy / true height)
  double overlap = 0;                      // intersection over union; 0 where nothing is reported
  std::optional<Box> truth;                // the true box of the policy
  std::optional<Box> reported;             // the tracker's box
  double distance_m = 0;                   // of the intruder from the camera
  bool is_lost = false;                    // scored, and nothing reported or no overlap
};

inline constexpr int kPrecisionSteps = 51;   // thresholds 0, 1, ... 50 px
inline constexpr int kSuccessSteps = 21;     // overlap thresholds 0, 0.05, ... 1
inline constexpr int kNormalizedSteps = 51;  // thresholds 0, 0.01, ... 0.5

// The figures of one tracker on one target. Fractions are of the scored frames; a frame without a report misses every
// threshold. Errors are over the scored frames with a report. NaN where there is no such frame.
struct TrackScore {
  std::string name;
  std::vector<FrameScore> frames;  // one for each of the clip
  int scored = 0;
  int reported = 0;         // of the scored
  int lost = 0;             // of the scored
  int reported_absent = 0;  // frames with a report and no truth
  double mean_center_error_px = 0;
  double median_center_error_px = 0;
  double p95_center_error_px = 0;
  double mean_dx_px = 0;
  double mean_dy_px = 0;
  std::array<double, kPrecisionSteps> precision{};  // fraction with CLE <= threshold, in pixels
  double precision_at_20 = 0;
  std::array<double, kSuccessSteps> success{};  // fraction with overlap > threshold (at 1: >= 1)
  double success_auc = 0;                       // mean of success
  double mean_overlap = 0;
  std::array<double, kNormalizedSteps> normalized_precision{};  // fraction with normalized_error <= threshold
  double normalized_precision_auc = 0;                          // mean of normalized_precision
  std::optional<double> frames_per_s;                           // of the tracker, where it is known
};

// Scores the results of one tracker; a frame with several boxes is scored by its best (Results::best_at).
[[nodiscard]] TrackScore score_track(const ClipTruth& clip, const TargetTruth& target, const Results& results,
                                     const TrackPolicy& policy);

// The first frame in which a tracker can be started: the policy counts it, and both sides of its true box are at least
// min_side_px. The footage's number; nullopt: there is none.
[[nodiscard]] std::optional<int> first_frame_to_track(const ClipTruth& clip, const TargetTruth& target,
                                                      const TrackPolicy& policy, double min_side_px);

// Default of the shortest side that the true box has in the frame in which trackers are started.
inline constexpr double kMinSide_px = 1;

// The policy with from_frame set to that first frame, at which scoring begins, also for results that are read from
// files (their ResultsOptions::start_frame). nullopt: no tracker can be started on this target.
[[nodiscard]] std::optional<TrackPolicy> policy_from_start(const ClipTruth& clip, const TargetTruth& target,
                                                           TrackPolicy policy = {}, double min_side_px = kMinSide_px);

// How well trackers follow on many clips: over all frames, each counting alike, and over clips, each counting alike.

// One intruder of one clip, and what each tracker did there.
struct TrackSetClip {
  std::string name;                // no two are alike
  std::string target;              // "intruder 0 (jet)"
  int from_frame = 0;              // at which the trackers started
  std::vector<TargetFrame> truth;  // one for each frame of the clip
  std::vector<TrackScore> scores;  // one for each tracker, in the set's order
};

// The figures of one tracker. Means over clips leave out clips in which the figure does not exist; NaN: there is none.
struct TrackSetFigures {
  TrackScore over_frames;  // of all clips, one behind the other; frames_per_s is of all frames by all time
  double clips_center_error_px = 0;
  double clips_precision_at_20 = 0;
  double clips_success_auc = 0;
  double clips_normalized_precision_auc = 0;
  double clips_mean_overlap = 0;
  double clips_lost_share = 0;
  Interval frames_success;  // of the success AUC over all frames, by drawing clips anew
  Interval clips_success;   // of its mean over clips
};

// The frames scored that have something in common, of one tracker.
struct TrackSlice {
  std::string by;  // as FrameSlice
  std::string name;
  int frames = 0;
  double mean_overlap = 0;  // NaN where there is no frame
  Interval interval;        // of it, by drawing clips anew
};

// The scores of several trackers on the same clips.
struct TrackSetReport {
  std::vector<std::string> trackers;
  TrackPolicy policy;
  double min_side_px = kMinSide_px;
  std::vector<TrackSetClip> clips;
  std::vector<std::string> remarks;             // clips left out, trackers that could not be started, ...
  std::vector<TrackSetFigures> figures;         // of each tracker, by complete()
  std::vector<std::vector<TrackSlice>> slices;  // likewise
};

// Computes figures and slices.
void complete(TrackSetReport& report);

// For each clip: the success AUC of a tracker times the frames scored, and the frames; or the AUC, and 1.
[[nodiscard]] std::vector<GroupShare> success_by_frames(const TrackSetReport& report, std::size_t tracker);
[[nodiscard]] std::vector<GroupShare> success_by_clips(const TrackSetReport& report, std::size_t tracker);

}  // namespace sigs
