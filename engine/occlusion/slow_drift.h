// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "occlusion/mean_frame.h"

namespace sigs {

// Which pixels drift slowly: clouds and a horizon that move by less than a pixel a second, which the difference of two
// frames does not show. In a window around each pixel, the shift of every footage segment against the mean of all is
// found by least squares on the gradient (Lucas and Kanade, 1981, one derivative higher, so that a change of contrast
// or brightness is not taken for a shift). The result is how far the shifts of successive segments agree; vibration and
// noise, which differ from segment to segment, cancel out.
//   segments  at least one
//   ratio     MotionEvidence::ratio: pixels that are known to move get little weight, so that they do not affect their
//             neighbours
// CV_32FC1 of ratio's size: 0: stays, or has no structure that could show a drift .. 1: drifts.
[[nodiscard]] cv::Mat drifting(const std::vector<MeanFrame>& segments, const cv::Mat& ratio);

}  // namespace sigs
