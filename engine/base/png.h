// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>
#include <string>
#include <vector>

// The PNG files that are read and written all the time, by libpng alone: OpenCV's library for image files takes longer
// to load than a frame takes to decode. Part of image_codecs.h, which uses OpenCV for everything else.
namespace sigs::image_codecs {

// A file of 8 bits as OpenCV's IMREAD_UNCHANGED gives it: CV_8UC1, CV_8UC3 (blue, green, red) or CV_8UC4. Empty for all
// that is to be left to OpenCV: other formats, palettes, other depths, interlaced and damaged files.
[[nodiscard]] cv::Mat plain_png(const std::string& file);

// The bytes of the PNG file that OpenCV writes of such an image without parameters. Empty where it is left to OpenCV:
// all types but CV_8U and CV_16U of 1, 3 or 4 channels.
[[nodiscard]] std::vector<uchar> plain_png_bytes(const cv::Mat& image);

}  // namespace sigs::image_codecs
