// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>

#include "video/frame.h"

namespace sigs {

// The image's luma, CV_8UC1. Plane 0 itself, samples shared, where the footage has luma; of RGB the weighted sum of
// ITU-R BT.709, full range, weights rounded to 1/256.
[[nodiscard]] cv::Mat luma_of(const Frame& frame);

}  // namespace sigs
