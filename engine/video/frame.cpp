// SPDX-License-Identifier: MIT
#include "video/frame.h"

#include "video/chroma.h"

namespace sigs {

Frame cloned(const Frame& frame) {
  Frame copy = frame;
  for (cv::Mat& plane : copy.planes) plane = plane.clone();
  return copy;
}

Frame blank_frame(PixelLayout layout, cv::Size size_px, const ColorInfo& color) {
  Frame frame{.layout = layout, .color = color};
  for (int i = 0; i < frame.plane_count(); ++i)
    frame.planes[static_cast<size_t>(i)] = cv::Mat::zeros(i == 0 ? size_px : chroma_size(layout, size_px), CV_8UC1);
  return frame;
}

cv::Size chroma_step(PixelLayout layout) {
  switch (layout) {
    case PixelLayout::yuv420:
      return {2, 2};
    case PixelLayout::yuv422:
      return {2, 1};
    case PixelLayout::gray:
    case PixelLayout::yuv444:
    case PixelLayout::rgb:
      break;
  }
  return {1, 1};
}

}  // namespace sigs
