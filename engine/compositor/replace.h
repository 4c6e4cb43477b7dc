// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>

#include "video/frame.h"

namespace sigs {

// Puts pixels of an 8-bit BGR image into the frame's own planes, in the part of it that rect names. Gives back how
// many were rewritten.
//   bgr     of rect's size
//   weight  CV_32FC1 of rect's size: 0 leaves the pixel's samples as they are, 1 replaces them, between mixes
std::int64_t replace_pixels(Frame& frame, const cv::Rect& rect, const cv::Mat& bgr, const cv::Mat& weight);

// The same over the whole image.
std::int64_t replace_pixels(Frame& frame, const cv::Mat& bgr, const cv::Mat& weight);

}  // namespace sigs
