// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>

#include "project/project.h"

// The steps of the paper's section 4, in its order. Images are CV_8UC1; masks hold 0 and 255.
namespace sigs {

// Adds a difference of two frames (CV_8UC1), scaled so that its largest sample counts 1, to the sum (CV_32FC1). One
// that is black adds nothing. Returns whether it added anything. Paper 4.1: "computed and normalized".
bool add_normalised(const cv::Mat& difference, cv::Mat& sum);

// The sum with its least value at 0 and its largest at 255; black where all of it is one value.
[[nodiscard]] cv::Mat normalised_sum(const cv::Mat& sum);

// Of the gradient's length by Sobel's 3x3 operators, in an image of 0..255. low <= high.
struct CannyThresholds {
  double low = 0;
  double high = 0;
};

// The settings' thresholds. Where they are 0: high parts the gradients of the image in two by Otsu's method (IEEE
// Trans. SMC 9, 1979), low is 0.4 of high.
[[nodiscard]] CannyThresholds canny_thresholds(const cv::Mat& image, const PaperOwnBodySettings& settings);

[[nodiscard]] cv::Mat canny_edges(const cv::Mat& image, const CannyThresholds& thresholds);

// The settings' diameters. Where they are 0: 5 and 9 px on the paper's 1280x960, in proportion to the diagonal on other
// sizes, and at least 3 px.
[[nodiscard]] int dilation_px(const PaperOwnBodySettings& settings, cv::Size size_px);
[[nodiscard]] int closing_px(const PaperOwnBodySettings& settings, cv::Size size_px);

// Every pixel that lies within half the diameter from one of the mask.
[[nodiscard]] cv::Mat dilated(const cv::Mat& mask, int diameter_px);

// Dilated, then eroded by as much: gaps narrower than the diameter are closed. Beyond the rim nothing is eroded from.
[[nodiscard]] cv::Mat closed(const cv::Mat& mask, int diameter_px);

// The mask's external contours filled: all that cannot be reached from outside the image, going over black by sides.
// What is open towards the rim is open.
[[nodiscard]] cv::Mat contours_filled(const cv::Mat& mask);

// Where Sobel's 3x3 operator across or the one down sees any change: two pixels wide along each border of the mask.
// The rim is no border.
[[nodiscard]] cv::Mat sobel_edges(const cv::Mat& mask);

// The mask with one column more on the left and right and one row more at the bottom, these white: the row throughout,
// the left column up to the height of the highest pixel in the leftmost column that is not black, the right one alike.
// A mask without pixels gets no white sides.
[[nodiscard]] cv::Mat padded(const cv::Mat& mask);

// The part of a padded mask that is the image.
[[nodiscard]] cv::Mat unpadded(const cv::Mat& padded_mask);

// Without the parts (8-connected) of fewer pixels than this share of the image's.
[[nodiscard]] cv::Mat without_small(const cv::Mat& mask, double least_area_percent);

}  // namespace sigs
