// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>

#include "base/result.h"
#include "cli/tracked_clip.h"

namespace sigs::cli {

// Whether the path is a folder of many clips: a dataset, or a folder of otb or vot sequences.
[[nodiscard]] bool is_track_set(const std::filesystem::path& path);

// `sigs evaluate track` on many clips, request.jobs of them side by side: prints the figures and writes the report
// where a folder is named.
//   request  input.file is the folder; results are folders, one for each tracker, with a file for each clip
//   split    only these clips of a dataset; empty: all
// Errors: of a clip that comes first in their order, whatever the number of jobs; interrupted. Nothing is written then.
[[nodiscard]] Result<void> evaluate_track_set(const TrackRequest& request, const std::string& split,
                                              const std::filesystem::path& folder, bool force);

}  // namespace sigs::cli
