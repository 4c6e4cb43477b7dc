// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "base/image.h"
#include "base/result.h"

namespace sigs {

// Reads where a target is in each frame of a clip: CSV with a header line and the columns frame,label,x,y,w,h in this
// order; frames count from 0, x and y are MATLAB's pixels, whose first one has its centre at (1, 1), as in the
// published boxes of the Svanstrom data set (doi:10.5281/zenodo.5500576). Returns boxes by frame, none where a frame
// has no line or a box without area. Where a frame has several lines the first one counts. Errors: cannot_read;
// bad_data (file and line) for what is no number, a frame beyond 10 million, no box at all.
[[nodiscard]] Result<std::vector<std::optional<Box>>> read_target_boxes(const std::filesystem::path& csv);

}  // namespace sigs
