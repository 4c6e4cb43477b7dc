// SPDX-License-Identifier: MIT
#include "evaluation/track_score.h"

namespace sigs {

TrackScore score_track(const FilmTruth&, const TargetTruth&, const Results&, const TrackPolicy&) {
  return {};
}

std::optional<int> first_frame_to_track(const FilmTruth&, const TargetTruth&, const TrackPolicy&, double) {
  return std::nullopt;
}

}  // namespace sigs
