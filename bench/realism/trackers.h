// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <vector>

#include "realism/samples.h"

namespace sigs::bench {

// How OpenCV's trackers follow each clip's real target and an inserted one that flies beside it: as large, along the
// same path, over the same 61 frames in the middle of the clip. Their boxes are compared with the published ones, and
// with the truth's. Writes trackers.csv (tracker, clip, kind, area under the success curve) and trackers.md: for each
// tracker and way to insert the mean difference between inserted and real, with an interval by bootstrap over clips.
void compare_trackers(const std::vector<RealClip>& clips, const SampleOptions& options, int jobs,
                      const std::filesystem::path& folder);

}  // namespace sigs::bench
