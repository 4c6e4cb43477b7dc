// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>
#include <vector>

namespace sigs {

// A part of the own body that hangs together, by sides or corners.
struct OwnBodyPart {
  cv::Rect box;
  cv::Mat mask;  // CV_8UC1 over box: 255 where it hides, else 0
  int pixels = 0;
};

// Where the own body hides at least half of what lies behind, in parts: a wing on the left and one on the right have
// boxes that leave out the sky between them. Largest first. Specks of less than a ten thousandth of the image are
// none.
//   own_body  CV_32FC1, 0 to 1, or empty
[[nodiscard]] std::vector<OwnBodyPart> own_body_parts(const cv::Mat& own_body);

}  // namespace sigs
