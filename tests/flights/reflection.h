// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>

namespace sigs::flights {

// A reflection in a windscreen or a dome: light that is added to everything behind it, so that the world
// is visible through it. It is fixed in the image, or drifts slowly as the sun moves. Not own body in the truth.
struct Reflection {
  double codes = 0;                  // of its brightest parts; 0: none
  cv::Rect2d where{0, 0.4, 1, 0.6};  // shares of width and height; it fades out there
  double creep_px = 0;               // to the right, per 100 frames of an image 640 wide
  double blur_px = 1.5;              // sigma, of an image 640 wide
  int things = 12;                   // sheets, dials and slots that are mirrored
  std::uint32_t seed = 1;
};

// Painted once; CV_8UC3 of the image's size, to be added.
[[nodiscard]] cv::Mat painted(const Reflection& reflection, cv::Size size_px);

void add_to(cv::Mat& image, const cv::Mat& painted, const Reflection& reflection, int frame);

}  // namespace sigs::flights
