// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <set>
#include <span>
#include <vector>

#include "evaluation/detection_score.h"

namespace sigs {

// Frames of a clip, from 0, both included, in which one target is visible and in range, but for short gaps.
struct EncounterSpan {
  int first = 0;
  int last = 0;
};

// Mean frame rate of a clip; of a single frame, its nominal one.
[[nodiscard]] double rate_hz_of(const ClipTruth& clip);

// Whether a target's frame belongs to an encounter: something of it is visible, within max_range_m.
[[nodiscard]] bool is_in_range(const TargetFrame& frame, const DetectionPolicy& policy);

// All such stretches, in order, however short and however near they come.
[[nodiscard]] std::vector<EncounterSpan> encounters_of(const TargetTruth& target, double rate_hz,
                                                       const DetectionPolicy& policy);

[[nodiscard]] bool is_long_enough(const EncounterSpan& encounter, double rate_hz, const DetectionPolicy& policy);

// The last frame of the first window in which one track (boxes without a track together are one) matches the target in
// min_window_share of the frames in which it is in range. Windows lie within the encounter; one longer than it is
// the encounter. tracks: of each frame of the clip.
[[nodiscard]] std::optional<int> confirmed_at(const EncounterSpan& encounter, const TargetTruth& target,
                                              std::span<const std::set<int>> tracks, double rate_hz,
                                              const DetectionPolicy& policy);

// The last frame at which it must be confirmed to be in time: the one before it first comes nearer than detect_range_m,
// but not before the first window's end.
[[nodiscard]] int deadline_of(const EncounterSpan& encounter, const TargetTruth& target, double rate_hz,
                              const DetectionPolicy& policy);

}  // namespace sigs
