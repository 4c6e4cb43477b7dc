// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>
#include <vector>

namespace sigs {

// Boxes that together cover the own body, for formats that know no masks as regions to ignore. A part that fills less
// than three quarters of its box is cut in two across the box's longer side, down to a sixteenth of the image's, so
// that a thin slanting strut does not take half of the image with it. Every pixel of the body lies in exactly one
// box; each box is the smallest around what it covers.
//   mask  CV_32FC1, as LabelSequence::own_body; body where it is 0.5 or more. Empty: no boxes
[[nodiscard]] std::vector<cv::Rect> own_body_boxes(const cv::Mat& mask);

}  // namespace sigs
