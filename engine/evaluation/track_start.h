// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "evaluation/track_score.h"

namespace sigs {

// The shortest side of a true box in which a tracker is started, where nothing else is asked for.
inline constexpr double kMinSide_px = 1;

// The policy with from_frame set to where trackers start: scoring begins there, for results that are read too, whose
// ResultsOptions::start_frame it is. nullopt: the target can be followed nowhere.
[[nodiscard]] std::optional<TrackPolicy> policy_from_start(const ClipTruth& clip, const TargetTruth& target,
                                                           TrackPolicy policy = {}, double min_side_px = kMinSide_px);

}  // namespace sigs
