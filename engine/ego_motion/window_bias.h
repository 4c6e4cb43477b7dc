// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>
#include <span>
#include <vector>

namespace sigs {

// Lucas and Kanade's method finds one shift for a whole window. Where the image also grows, turns or shears, that shift
// is the one of a place at which the window has its gradients, not of the window's middle. From one key image to the
// next these errors add up: a feature that grows by half or turns by 30 degrees slides by half a pixel.
// The error is linear in the gradient of the displacement, to which neighbouring features are known witnesses.

// The shift that the method finds at a window's middle if the image is displaced by A x there, x from the middle:
// by * (A11, A12, A21, A22).
using WindowResponse = cv::Matx<float, 2, 4>;

//   derivatives  CV_16SC2, of the key image by x and y
//   middle_px    half a window and 1 px or more within the image
//   half_px      the window is 2 * half_px + 1 wide and high
// Zero where the window has no corner.
[[nodiscard]] WindowResponse window_response(const cv::Mat& derivatives, cv::Point2f middle_px, int half_px);

// The gradient A of the displacement (11, 12, 21, 22) around each feature: by weighted least squares over the features
// in the neighbourhood, in which those that move otherwise than most lose their weight. Near 0 where there are few.
//   from_px, to_px  of the same features, as many of each
//   size_px         of the image
[[nodiscard]] std::vector<cv::Vec4f> displacement_gradients(std::span<const cv::Point2f> from_px,
                                                            std::span<const cv::Point2f> to_px, cv::Size size_px);

}  // namespace sigs
