// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "evaluation/metrics/slices.h"
#include "evaluation/metrics/track_score.h"

namespace sigs {

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
  TrackScore over_frames;  // pooled_score()
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
