// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "evaluation/clip_truth.h"
#include "evaluation/results.h"

namespace sigs {

// Which of the truth's boxes a tracker is measured against.
enum class TruthBox { visible, amodal };

// What is scored. docs/evaluation.md says why.
struct TrackPolicy {
  TruthBox truth = TruthBox::visible;
  int from_frame = 0;  // the footage's number; frames before it are not scored (the tracker was started there)
  double min_visible_fraction = 0;  // frames in which less of the intruder can be seen are not scored: hidden by the
                                    // own body, or cut off by the image's edge
};

struct FrameScore {
  int frame = 0;  // the footage's number
  double time_s = 0;
  bool is_scored = false;  // the truth has a box, and the policy counts the frame
  bool is_reported = false;
  // Where both are: reported less true centre, in pixels; x to the right, y down. Centres are the middles of the edges,
  // so it makes no difference whether both are called x + w/2 or both x + (w-1)/2.
  std::optional<double> dx_px;
  std::optional<double> dy_px;
  std::optional<double> center_error_px;   // CLE: length of (dx, dy)
  std::optional<double> normalized_error;  // length of (dx / true width, dy / true height)
  double overlap = 0;                      // intersection over union; 0 where nothing is reported
  std::optional<Box> truth;                // the box that it is measured against
  std::optional<Box> reported;             // the tracker's
  double distance_m = 0;                   // of the intruder
  bool is_lost = false;                    // scored, and nothing reported or no overlap
};

inline constexpr int kPrecisionSteps = 51;   // thresholds 0, 1, ... 50 px
inline constexpr int kSuccessSteps = 21;     // overlap thresholds 0, 0.05, ... 1
inline constexpr int kNormalizedSteps = 51;  // thresholds 0, 0.01, ... 0.5

// Shares are of the scored frames; a frame without a report misses every threshold. Errors are over the frames with a
// report. NaN where there is no such frame.
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
  std::array<double, kPrecisionSteps> precision{};  // share with CLE <= threshold
  double precision_at_20 = 0;
  std::array<double, kSuccessSteps> success{};  // share with overlap > threshold (at 1: >= 1)
  double success_auc = 0;                       // mean of success
  double mean_overlap = 0;
  std::array<double, kNormalizedSteps> normalized_precision{};
  double normalized_precision_auc = 0;  // mean of normalized_precision
  std::optional<double> frames_per_s;
};

[[nodiscard]] TrackScore score_track(const ClipTruth& clip, const TargetTruth& target, const Results& results,
                                     const TrackPolicy& policy);

// First frame from which a tracker can be started: the truth has a box whose sides are both at least min_side_px, and
// the policy counts it. The footage's number.
[[nodiscard]] std::optional<int> first_frame_to_track(const ClipTruth& clip, const TargetTruth& target,
                                                      const TrackPolicy& policy, double min_side_px);

}  // namespace sigs
