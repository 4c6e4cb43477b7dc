// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>
#include <vector>

namespace sigs {

// An edge of the image followed from pixel to pixel, to parts of a pixel: a straight line of the world, perhaps.
using EdgeChain = std::vector<cv::Point2d>;

// Long edges of an image that bend little: edges by Canny (1986), places across them by a parabola through the steepest
// slopes. Each is at least `least_length` of the image's width long from end to end, deviates from its chord by less
// than a fifteenth of that, and follows a smooth curve to 0.5 px. In pixels of `luma`, CV_8UC1.
[[nodiscard]] std::vector<EdgeChain> long_edges(const cv::Mat& luma, double least_length);

}  // namespace sigs
