// SPDX-License-Identifier: MIT
#include "evaluation/track_start.h"

namespace sigs {

std::optional<TrackPolicy> policy_from_start(const ClipTruth& clip, const TargetTruth& target, TrackPolicy policy,
                                             double min_side_px) {
  const std::optional<int> first = first_frame_to_track(clip, target, policy, min_side_px);
  if (!first) return std::nullopt;
  policy.from_frame = *first;
  return policy;
}

}  // namespace sigs
