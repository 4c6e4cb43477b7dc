// SPDX-License-Identifier: MIT
#pragma once

#include <set>
#include <vector>

#include "evaluation/detection_score.h"

namespace sigs {

// Overlap that forgives a pixel or two where the truth is tiny: if its area is less than min_area_px2, it and the
// reported box, where that is smaller too, are first grown to that area about their middles, keeping their shape. A box
// without area becomes a square.
[[nodiscard]] double extended_overlap(const Box& truth, const Box& reported, double min_area_px2);

// What the reports of one clip hit.
struct ClipMatches {
  // [target][frame of the clip, from 0]: the tracks that match it there; kNoTrack among them: a box without one.
  std::vector<std::vector<std::set<int>>> tracks;
  std::set<int> false_tracks;  // with at least one false alarm, without kNoTrack
  int untracked_false_boxes = 0;
  int false_boxes = 0;  // of any track or none
};

// A report may match several targets, a target several reports. A report at an intruder that is hidden (its silhouette
// without a visible box) is no false alarm.
[[nodiscard]] ClipMatches matches_of(const DetectedClip& clip, const DetectionPolicy& policy);

}  // namespace sigs
