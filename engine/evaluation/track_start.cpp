// SPDX-License-Identifier: MIT
#include "evaluation/track_start.h"

namespace sigs {

std::optional<TrackPolicy> policy_from_start(const FilmTruth& film, const TargetTruth& target, TrackPolicy policy,
                                             double least_side_px) {
  const std::optional<int> first = first_frame_to_track(film, target, policy, least_side_px);
  if (!first) return std::nullopt;
  policy.from_frame = *first;
  return policy;
}

}  // namespace sigs
