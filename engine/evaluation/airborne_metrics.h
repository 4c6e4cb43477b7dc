// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <set>
#include <span>
#include <vector>

#include "evaluation/detection_score.h"

namespace sigs {

// The two halves of the airborne metrics (detection_score.h): encounters, which follow from the truth alone, and
// matches of reports with the truth.

// The frames of an encounter, counted from 0 in the clip, both included: one target is visible and in range in all of
// them except for short gaps.
struct EncounterSpan {
  int first = 0;
  int last = 0;
};

// Mean frame rate of a clip; of a single frame, its nominal one.
[[nodiscard]] double rate_hz_of(const ClipTruth& clip);

// Whether a target's frame belongs to an encounter: some of it is visible, within max_range_m.
[[nodiscard]] bool is_in_range(const TargetFrame& frame, const DetectionPolicy& policy);

// All encounters of a target, in order, of any duration and minimum range.
[[nodiscard]] std::vector<EncounterSpan> encounters_of(const TargetTruth& target, double rate_hz,
                                                       const DetectionPolicy& policy);

// Whether it lasts at least min_encounter_s.
[[nodiscard]] bool is_long_enough(const EncounterSpan& encounter, double rate_hz, const DetectionPolicy& policy);

// The last frame of the first window in which one track matches the target in at least min_window_share of the frames
// in which the target is in range; boxes without a track together count as one. Windows have window_s, or the length
// of a shorter encounter, and lie within the encounter. nullopt: there is none.
//   tracks  the tracks that match the target in each frame of the clip (ClipMatches::tracks)
[[nodiscard]] std::optional<int> confirmed_at(const EncounterSpan& encounter, const TargetTruth& target,
                                              std::span<const std::set<int>> tracks, double rate_hz,
                                              const DetectionPolicy& policy);

// The last frame at which a confirmation is in time: the one before the target first comes nearer than detect_range_m,
// but not before the end of the first window.
[[nodiscard]] int deadline_of(const EncounterSpan& encounter, const TargetTruth& target, double rate_hz,
                              const DetectionPolicy& policy);

// Overlap that tolerates a pixel or two where the true box is tiny: if its area is less than min_area_px2, it and the
// reported box, where that is smaller too, are first enlarged to that area about their centres, keeping their aspect
// ratio. A box without area becomes a square.
[[nodiscard]] double extended_overlap(const Box& truth, const Box& reported, double min_area_px2);

// The matches of all reports of one clip.
struct ClipMatches {
  // [target][frame of the clip, from 0]: the tracks that match it; kNoTrack stands for boxes without a track.
  std::vector<std::vector<std::set<int>>> tracks;
  std::set<int> false_tracks;     // with at least one false alarm, without kNoTrack
  int untracked_false_boxes = 0;  // false alarms without a track
  int false_boxes = 0;            // all false alarms
};

// Matches the reports of a clip with its truth. A report can match several targets, and a target several reports. A
// report at a hidden intruder (one with an amodal box and no visible box) is no false alarm, nor is one near a box that
// is ignored (ClipTruth::ignored), or at least half of which lies in it.
[[nodiscard]] ClipMatches matches_of(const DetectedClip& clip, const DetectionPolicy& policy);

}  // namespace sigs
