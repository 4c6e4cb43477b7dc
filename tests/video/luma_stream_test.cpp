// SPDX-License-Identifier: MIT
#include "video/luma_stream.h"

#include <doctest/doctest.h>

#include <cmath>

namespace sigs::test {

TEST_CASE("luma is plane 0 itself where the footage has luma") {
  for (const PixelLayout layout : {PixelLayout::gray, PixelLayout::yuv420, PixelLayout::yuv422, PixelLayout::yuv444}) {
    const Frame frame = blank_frame(layout, {5, 3}, {});
    CHECK(luma_of(frame).data == frame.planes[0].data);
  }
}

TEST_CASE("luma of RGB is the weighted sum of BT.709 and of grey it is grey") {
  Frame frame = blank_frame(PixelLayout::rgb, {256, 4}, {});
  cv::RNG chance(3);
  for (cv::Mat& plane : frame.planes) chance.fill(plane, cv::RNG::UNIFORM, 0, 256);
  for (cv::Mat& plane : frame.planes)
    for (int x = 0; x < 256; ++x) plane.at<uchar>(0, x) = static_cast<uchar>(x);
  const cv::Mat luma = luma_of(frame);
  for (int x = 0; x < 256; ++x) CHECK(luma.at<uchar>(0, x) == x);
  for (int y = 1; y < 4; ++y)
    for (int x = 0; x < 256; ++x) {
      const double exact = 0.2126 * frame.planes[0].at<uchar>(y, x) + 0.7152 * frame.planes[1].at<uchar>(y, x) +
                           0.0722 * frame.planes[2].at<uchar>(y, x);
      // Weights are off by at most 0.0021 (blue: 19/256) on 255 codes, and rounding by half a code.
      CHECK(std::abs(luma.at<uchar>(y, x) - exact) <= 1.1);
    }
}

}  // namespace sigs::test
