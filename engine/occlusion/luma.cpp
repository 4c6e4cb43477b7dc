// SPDX-License-Identifier: MIT
#include "occlusion/luma.h"

namespace sigs {

namespace {

// ITU-R BT.709: 0.2126, 0.7152, 0.0722. They add up to 256, so grey keeps its code.
constexpr int kRed = 54;
constexpr int kGreen = 183;
constexpr int kBlue = 19;
static_assert(kRed + kGreen + kBlue == 256);

}  // namespace

cv::Mat luma_of(const Frame& frame) {
  if (frame.layout != PixelLayout::rgb) return frame.planes[0];
  cv::Mat luma(frame.size_px(), CV_8UC1);
  for (int y = 0; y < luma.rows; ++y) {
    const uchar* const red = frame.planes[0].ptr<uchar>(y);
    const uchar* const green = frame.planes[1].ptr<uchar>(y);
    const uchar* const blue = frame.planes[2].ptr<uchar>(y);
    uchar* const out = luma.ptr<uchar>(y);
    for (int x = 0; x < luma.cols; ++x)
      out[x] = static_cast<uchar>((kRed * red[x] + kGreen * green[x] + kBlue * blue[x] + 128) >> 8);
  }
  return luma;
}

}  // namespace sigs
