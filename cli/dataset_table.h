// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/result.h"
#include "dataset/dataset_lock.h"
#include "dataset/footage_cache.h"
#include "dataset/plan.h"

namespace sigs::cli {

// The plan's videos that are this shard's.
[[nodiscard]] std::vector<const PlannedVideo*> videos_of(const Plan& plan, const Shard& shard);

// "sampled again: never in the image 4 times; speed_mps once\n"; empty where no video was sampled anew.
[[nodiscard]] std::string resamples_line(const std::vector<const PlannedVideo*>& videos);

// What would be made, a line a video, columns aligned: name, split, background, aircraft, flight, frames, frames in
// view, the silhouette's size, how often it was sampled anew, and what was sampled, to four digits. Videos of other
// quantities have a table of their own. What all videos of a table share stands in one line below it. The last line is
// the sum. visibilities: one a video.
[[nodiscard]] Result<std::string> table_of(const std::vector<const PlannedVideo*>& videos,
                                           const std::vector<std::optional<Visibility>>& visibilities);

}  // namespace sigs::cli
