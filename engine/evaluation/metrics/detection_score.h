// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "evaluation/readers/clip_truth.h"
#include "evaluation/readers/results.h"

namespace sigs {

// How well a detector finds intruders: the metrics published with the Airborne Object Tracking challenge, the encounter
// detection rate (EDR) and the hourly false alarm rate (HFAR). docs/evaluation.md defines each and says where SIGS
// differs. What is published in frames at 10 Hz is in seconds here.

// The parameters of the metrics.
struct DetectionPolicy {
  double min_area_px2 = 100;         // extended overlap: where the true box is smaller, both boxes are enlarged to it
  double match_overlap = 0.2;        // minimum extended overlap of a match
  double false_overlap = 0.02;       // less with every true box: a false alarm; between the two: neither
  double min_score = 0;              // reports with a lower score are ignored
  double max_range_m = 700;          // from the camera, in an encounter
  double max_closest_range_m = 330;  // the minimum range of a counted encounter is this or less
  double min_encounter_s = 3;        // duration of a counted encounter
  double max_gap_s = 0.3;            // not visible or out of range without ending an encounter
  double detect_range_m = 300;  // an encounter is detected in time where it is before it comes nearer than this, or
  double window_s = 3;          // in its first window: by one track in a share of the frames of a window of this length
  double min_window_share = 0.5;
};

// One clip and the results of a detector on it.
struct DetectedClip {
  std::string name;
  ClipTruth truth;
  Results results;
};

// An encounter: consecutive frames in which one target is visible and in range. Frames are the footage's numbers.
struct EncounterScore {
  std::string clip;
  int target = 0;
  int first_frame = 0;
  int last_frame = 0;
  HorizonSide horizon = HorizonSide::unknown;  // above or below: in all its frames; unknown: in any
  double min_range_m = 0;
  bool is_detected = false;                       // in time
  std::optional<double> first_detection_range_m;  // range at its first match
  std::optional<double> first_detection_time_s;   // from the encounter's first frame
  std::optional<double> confirmed_range_m;        // at the end of the first window with enough matches, in time or not
  std::optional<double> confirmed_time_s;         // from the encounter's first frame
  int frames_visible = 0;                         // within max_range_m
  int frames_matched = 0;                         // of these
};

// Counted encounters and how many of them were detected in time.
struct DetectionRate {
  int encounters = 0;
  int detected = 0;
  [[nodiscard]] double rate() const;  // detected / encounters; NaN where there is none
};

// The figures of one detector over all clips. The rates by horizon are by the side on which the encounter lies.
struct DetectionScore {
  std::string name;
  std::vector<EncounterScore> encounters;
  DetectionRate all;
  DetectionRate above_horizon;
  DetectionRate on_horizon;
  DetectionRate below_horizon;
  DetectionRate unknown_horizon;
  int encounters_too_short = 0;  // shorter than min_encounter_s, at any range: not counted, not listed
  int encounters_too_far = 0;    // of the others, those that never come within max_closest_range_m: not counted either
  int frames = 0;
  double hours = 0;                  // NaN where the truth of a clip has no times
  int false_alarm_tracks = 0;        // tracks with at least one false alarm; a box without a track counts as one
  double false_alarms_per_hour = 0;  // HFAR: false_alarm_tracks / hours; NaN for no hours
  int false_alarm_boxes = 0;
  double false_boxes_per_frame = 0;  // FPPI; NaN for no frames
  double frame_detection_rate = 0;   // AFDR: matched (frame, target) pairs of all within max_range_m; NaN for none
  int negative_scores_ignored = 0;   // reports whose score is below 0 and below min_score, as logits may be
  double mean_first_range_m = 0;     // first_detection_range_m over encounters with one; NaN where there is none
};

// Scores the results of one detector. Track numbers are per clip: two clips may both have a track 7.
[[nodiscard]] DetectionScore score_detections(const std::string& name, const std::vector<DetectedClip>& clips,
                                              const DetectionPolicy& policy);

// Which figures leave out what since the truth does not say it (ranges, identities, rates), a sentence each; empty: the
// truth of SIGS says it all. Objects of unknown range are in no encounter, and a report at one is no false alarm.
[[nodiscard]] std::vector<std::string> left_out_of(const std::vector<DetectedClip>& clips);

// Mean frame rate of a clip; of a single frame, its nominal one.
[[nodiscard]] double rate_hz_of(const ClipTruth& clip);

// Intersection over union (Jaccard index) of the areas of two boxes, 0 to 1. 0 where they do not intersect or one has
// no area.
[[nodiscard]] inline double overlap(const Box& a, const Box& b) {
  const double width = std::min(a.x + a.width, b.x + b.width) - std::max(a.x, b.x);
  const double height = std::min(a.y + a.height, b.y + b.height) - std::max(a.y, b.y);
  if (!(width > 0 && height > 0)) return 0;
  const double both = width * height;
  const double either = a.width * a.height + b.width * b.height - both;
  return std::clamp(both / either, 0.0, 1.0);  // either > 0: it is at least the larger area
}

// Whether value is greater than threshold by more than 1e-9, so that rounding of decimals does not matter: 5 px may be
// stored as 5.000000000000001.
[[nodiscard]] inline bool exceeds(double value, double threshold) {
  constexpr double kRounding = 1e-9;
  return value > threshold + kRounding;
}

// Overlap that tolerates a pixel or two where the true box is tiny: if its area is less than min_area_px2, it and the
// reported box, where that is smaller too, are first enlarged to that area about their centres, keeping their aspect
// ratio. A box without area becomes a square.
[[nodiscard]] double extended_overlap(const Box& truth, const Box& reported, double min_area_px2);

// The matches of all reports of one clip.
struct ClipMatches {
  // [target][frame of the clip, from 0]: the tracks that match it; kNoTrack stands for boxes without a track.
  std::vector<std::vector<std::set<int>>> tracks;
  std::set<int> false_tracks;                                   // with at least one false alarm, without kNoTrack
  int untracked_false_boxes = 0;                                // false alarms without a track
  int false_boxes = 0;                                          // all false alarms
  std::vector<std::pair<int, ReportedBox>> false_reports = {};  // these, each with its frame of the clip, from 0
  int negative_scores = 0;                                      // reports of a score below 0 that are ignored
};

// Matches the reports of a clip with its truth. A report can match several targets, and a target several reports. A
// report near an intruder's amodal box is no false alarm, whether anything of it is visible or not, nor is one near a
// box that is ignored (ClipTruth::ignored), or at least half of which lies in it.
[[nodiscard]] ClipMatches matches_of(const DetectedClip& clip, const DetectionPolicy& policy);

}  // namespace sigs
