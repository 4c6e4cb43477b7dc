// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "occlusion/mean_frame.h"

namespace sigs {

// Which pixels creep: clouds and a horizon that move by less than a pixel a second, which no two frames tell. Around
// each pixel the shift of every footage segment against their mean image is found by least squares on the gradient
// (after Lucas and Kanade, 1981, one derivative higher: a change of contrast or of the light then is no shift). What
// counts is how far the shifts of successive segments agree, so that vibration and noise, which differ from segment to
// segment, cancel. 0 stays, or shows nothing that could be seen to creep .. 1 creeps; CV_32FC1.
//
// ratio: Motion::ratio. Pixels that are seen to move anyway do not count, so that they do not tell on their neighbours.
[[nodiscard]] cv::Mat drifting(const std::vector<MeanFrame>& segments, const cv::Mat& ratio);

}  // namespace sigs
