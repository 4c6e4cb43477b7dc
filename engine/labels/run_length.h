// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <span>
#include <string>
#include <vector>

namespace sigs {

// The lengths of the runs of a mask's pixels in COCO's order: down each column, the columns from left to right. The
// first run is of pixels that are off and may be 0 long, the next of pixels that are on, and so on by turns; their sum
// is the image's pixels.
//   mask     CV_8UC1 of box's size; on where it is not 0
//   box      where the mask lies, within the image; all beyond it is off
//   image  of fewer than 2^32 pixels
[[nodiscard]] std::vector<std::uint32_t> column_runs(const cv::Mat& mask, const cv::Rect& box, cv::Size image);

// Runs as the string that COCO's API calls a compressed RLE (maskApi, rleToString): from the fourth run on the
// difference to the last but one; of each number five bits a character, the lowest first, and a sixth bit where more
// follow; the last character's highest bit is the sign.
[[nodiscard]] std::string coco_counts(std::span<const std::uint32_t> runs);

}  // namespace sigs
