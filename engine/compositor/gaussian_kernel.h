// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>

namespace sigs {

// Pixels over which a Gaussian carries a pixel: ceil(3 sigma_px).
[[nodiscard]] int blur_margin_px(double sigma_px);

// One axis of a Gaussian on whole pixels: 2 margin + 1 samples (CV_32FC1, a column) that sum to one, with the variance
// sigma_px^2 also far below a pixel. Samples too small to change an 8-bit value are 0: a blur of negligible width
// changes no neighbour. sigma_px == 0 gives 1 in the middle.
//   margin  samples on each side; with blur_margin_px(sigma_px) the cut takes up to 2.7 % of the variance
[[nodiscard]] cv::Mat sampled_gaussian(double sigma_px, int margin);

}  // namespace sigs
