// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <optional>
#include <vector>

#include "base/result.h"
#include "dataset/plan.h"

namespace sigs {

// How a planned video's intruder is seen, told without drawing it (outlook.h).
struct VideoView {
  int looked_at = 0;       // frames, spread over the video with its first and last; all of them where none saw it
  int in_view = 0;         // of these: some of the silhouette lies in the picture, not all of it behind the own body
  double smallest_px = 0;  // longer side of the silhouette in those, the picture's edge left aside
  double largest_px = 0;
};

// For each video, in order; none where what its project names cannot be opened, or after cancel. Looks at up to
// `frames` frames of each.
[[nodiscard]] std::vector<std::optional<VideoView>> views_of(const std::vector<const PlannedVideo*>& videos, int frames,
                                                             const std::atomic<bool>* cancel);

}  // namespace sigs
