// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>

namespace sigs {

// Intersection over union of two masks, CV_8UC1 of one size: 1 where they are the same, 0 where they share nothing. A
// pixel belongs to a mask from half on (128). Two empty masks are the same: 1.
[[nodiscard]] double intersection_over_union(const cv::Mat& a, const cv::Mat& b);

}  // namespace sigs
