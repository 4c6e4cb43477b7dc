// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>

namespace sigs::cli {

// An image with a mask tinted over it, for people to look at. bgr: CV_8UC3; mask: CV_8UC1 of the same size.
[[nodiscard]] cv::Mat tinted(const cv::Mat& bgr, const cv::Mat& mask);

}  // namespace sigs::cli
