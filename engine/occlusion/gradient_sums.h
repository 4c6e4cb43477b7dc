// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>

#include "occlusion/mean_frame.h"

namespace sigs {

// Of each pixel, over time; CV_32FC1. Gradients are in gray levels per pixel of the images, these slightly blurred.
struct GradientMoments {
  cv::Mat mean_x, mean_y;
  cv::Mat mean_square;         // of the gradient's length
  double frames_per_mean = 1;  // that an image is the mean of, on average
};

// Gradients do not notice that the exposure shifts, and little that it scales.
class GradientSums {
 public:
  explicit GradientSums(cv::Size size);

  // Counts as many times as it stands for frames.
  void add(const MeanFrame& image);

  // A copy that shares nothing.
  [[nodiscard]] GradientSums clone() const;

  // Needs an image.
  [[nodiscard]] GradientMoments moments() const;

 private:
  int frames_ = 0;
  int mean_frames_ = 0;
  cv::Mat sum_x_, sum_y_, sum_square_;  // CV_32FC1
};

}  // namespace sigs
