// SPDX-License-Identifier: MIT
#include "editor/preview/frame_bytes.h"

namespace sigs::editor {

std::size_t bytes_of(const cv::Mat& picture) {
  return picture.total() * picture.elemSize();
}

std::size_t bytes_of(const Picture& picture) {
  std::size_t sum = bytes_of(picture.bgr) + bytes_of(picture.mask);
  for (const Stage& stage : picture.stages) sum += bytes_of(stage.picture);
  return sum;
}

std::size_t bytes_of(const Decoded& decoded) {
  std::size_t sum = 0;
  for (const cv::Mat& plane : decoded.frame.planes) sum += bytes_of(plane);
  return sum;
}

}  // namespace sigs::editor
