// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>

#include "project/project.h"

// The steps of section 4 of the paper, in its order; paper_method (detect.h) runs them. Images are CV_8UC1; masks hold
// 0 and 255. README.md says what the paper leaves open.
namespace sigs {

// Adds a difference of two frames (CV_8UC1), divided by its largest sample, to the sum (CV_32FC1). A black difference
// adds nothing. Returns whether it added anything. Paper 4.1: "computed and normalized".
bool add_normalised(const cv::Mat& difference, cv::Mat& sum);

// The sum scaled so that its minimum becomes 0 and its maximum 255; black where all values are equal.
[[nodiscard]] cv::Mat normalised_sum(const cv::Mat& sum);

// Thresholds of Canny's method: lengths of the gradient by Sobel's 3x3 operators in an image of 0..255. low <= high.
struct CannyThresholds {
  double low = 0;
  double high = 0;
};

// The thresholds of the settings. Where they are 0: high by Otsu's method on the lengths of the gradient (IEEE Trans.
// SMC 9, 1979), low 0.4 of high.
[[nodiscard]] CannyThresholds canny_thresholds(const cv::Mat& image, const PaperOwnBodySettings& settings);

// Canny's edges, with the Euclidean length of the gradient.
[[nodiscard]] cv::Mat canny_edges(const cv::Mat& image, const CannyThresholds& thresholds);

// The diameters of the settings in pixels. Where they are 0: 5 and 9 px for the paper's 1280x960, in proportion to the
// diagonal for other sizes, at least 3 px.
[[nodiscard]] int dilation_px(const PaperOwnBodySettings& settings, cv::Size size_px);
[[nodiscard]] int closing_px(const PaperOwnBodySettings& settings, cv::Size size_px);

// All pixels within half the diameter of a pixel of the mask.
[[nodiscard]] cv::Mat dilated(const cv::Mat& mask, int diameter_px);

// Dilated, then eroded by the same diameter: closes gaps narrower than the diameter. Does not erode from the image's
// edge.
[[nodiscard]] cv::Mat closed(const cv::Mat& mask, int diameter_px);

// The mask with its external contours filled: all pixels that are not connected (4-connectivity) to the outside of the
// image through black pixels. A contour that is open at the image's edge stays open.
[[nodiscard]] cv::Mat contours_filled(const cv::Mat& mask);

// Pixels at which Sobel's 3x3 operator in x or in y is not 0: a line two pixels wide along each border of the mask. The
// image's edge is not a border.
[[nodiscard]] cv::Mat sobel_edges(const cv::Mat& mask);

// The mask with one more column at the left and at the right and one more row at the bottom. The new row is white. The
// new left column is white from the bottom up to the highest pixel in the leftmost column of the mask that is not
// black; the new right column likewise. In a black mask the new columns stay black.
[[nodiscard]] cv::Mat padded(const cv::Mat& mask);

// The part of a padded mask that lies in the image.
[[nodiscard]] cv::Mat unpadded(const cv::Mat& padded_mask);

// The mask without its connected parts (8-connectivity) of fewer pixels than this percentage of the image's.
[[nodiscard]] cv::Mat without_small(const cv::Mat& mask, double min_area_percent);

}  // namespace sigs
