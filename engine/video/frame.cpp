// SPDX-License-Identifier: MIT
#include "video/frame.h"

namespace sigs {

Frame cloned(const Frame& frame) {
  Frame copy = frame;
  for (cv::Mat& plane : copy.planes) plane = plane.clone();
  return copy;
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
