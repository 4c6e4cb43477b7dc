// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>

#include "video/frame.h"

namespace sigs {

// Puts pixels of an 8-bit BGR picture into the frame's own planes.
//   weight  CV_32FC1 of the picture's size: 0 leaves the pixel's samples as they are, 1 replaces them, between mixes
void replace_pixels(Frame& frame, const cv::Mat& bgr, const cv::Mat& weight);

}  // namespace sigs
