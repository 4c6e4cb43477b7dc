// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>

namespace sigs {

// Distance of each pixel's middle from the middle of the nearest non-zero pixel, CV_32FC1; 0 on these, infinite
// everywhere in a black mask. mask: CV_8UC1.
[[nodiscard]] cv::Mat distance_px(const cv::Mat& mask);

// Distance of each pixel's middle from the mask's border, CV_32FC1: positive inside, negative outside. The border runs
// half a pixel from the middles on its two sides. The image's rim is no border: a body that reaches it goes on
// beyond. +infinity in a white mask, -infinity in a black one.
[[nodiscard]] cv::Mat signed_distance_px(const cv::Mat& mask);

// A hard mask (non-zero: body) with an edge that goes from 0 to 255 within width_px, centred on the border and linear
// in the signed distance from it. CV_8UC1. Up to 1 px, the pixels' own step, the mask stays hard.
[[nodiscard]] cv::Mat soft_edged(const cv::Mat& mask, double width_px);

}  // namespace sigs
