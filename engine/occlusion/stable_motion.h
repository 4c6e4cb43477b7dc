// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>

#include "occlusion/gradient_sums.h"

namespace sigs {

// What the gradient's moments tell of each pixel; CV_32FC1, gray levels and pixels of the mean images.
struct Motion {
  cv::Mat mean_square;  // of the mean gradient: edges that stay are strong in it
  cv::Mat variation;    // of the gradient about its mean, squared: what passes by is strong in it
  cv::Mat ratio;        // variation over what noise and vibration explain; above 1 something moves
  cv::Mat moving;       // 0 still as far as can be seen .. 1 surely moves
  double noise = 0;     // variation where nothing moves, with a margin for a body that shines and shakes
  double quietest = 0;  // variation in the stillest places
};

// vibration: how far the body shakes, in pixels of the mean images.
[[nodiscard]] Motion motion_of(const GradientMoments& moments, double vibration);

// What share of the gradient's energy stays, 0..1: 1 where it is always the same.
[[nodiscard]] cv::Mat coherence_of(const Motion& motion);

}  // namespace sigs
