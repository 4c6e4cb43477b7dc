// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>

// Distances, edges and overlap of masks. Masks are CV_8UC1. Pixel coordinates: base/image.h.
namespace sigs {

// Distance of each pixel's centre from the centre of the nearest non-zero pixel, CV_32FC1, in pixels: 0 on non-zero
// pixels; +infinity everywhere in a black mask.
[[nodiscard]] cv::Mat distance_px(const cv::Mat& mask);

// Distance of each pixel's centre from the mask's border, CV_32FC1, in pixels: positive inside, negative outside. The
// border runs half a pixel from the centres on its two sides. The edge of the image is not a border: a body that
// touches it continues beyond. +infinity in a white mask, -infinity in a black one.
[[nodiscard]] cv::Mat signed_distance_px(const cv::Mat& mask);

// A hard mask (non-zero: body) with a soft edge: from 0 to 255 within width_px, centred on the border, linear in the
// signed distance. CV_8UC1. width_px >= 0; up to 1, the step between two pixels, the mask stays hard.
[[nodiscard]] cv::Mat soft_edged(const cv::Mat& mask, double width_px);

// A round structuring element for cv::dilate and cv::erode, of 2 * radius + 1 pixels.
[[nodiscard]] cv::Mat disc(int radius);

// Intersection over union of two masks of one size: 1 where they are equal, 0 where they do not overlap. A pixel
// belongs to a mask from 128 on. Two empty masks are equal.
[[nodiscard]] double intersection_over_union(const cv::Mat& a, const cv::Mat& b);

}  // namespace sigs
