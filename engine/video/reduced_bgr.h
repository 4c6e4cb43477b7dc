// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>

#include "video/frame.h"

namespace sigs {

// A part of a frame made smaller, as 8-bit BGR (CV_8UC3), for display: pixel (i, j) has the mean luma of the block of
// divisor x divisor pixels that begins at (divisor * i, divisor * j) in the part, of those that there are at its right
// and lower edge, and the mean of the chroma samples that any of them has. It is the mean of bgr_of() to three codes;
// where colours change abruptly, chroma samples that belong to two blocks, and codes outside of what BGR has, add to
// that. Costs about one pass over the planes, where bgr_of() and an average take five times as long.
//   part     not empty, within the frame; its size is divided and rounded up
//   divisor  2 to 128
[[nodiscard]] cv::Mat reduced_bgr(const Frame& frame, const cv::Rect& part, int divisor);

}  // namespace sigs
