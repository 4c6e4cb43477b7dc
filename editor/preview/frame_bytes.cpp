// SPDX-License-Identifier: MIT
#include "editor/preview/frame_bytes.h"

namespace sigs::editor {

std::size_t bytes_of(const cv::Mat& image) {
  return image.total() * image.elemSize();
}

std::size_t bytes_of(const PreviewImage& image) {
  std::size_t sum = bytes_of(image.bgr) + bytes_of(image.mask);
  for (const Stage& stage : image.stages) sum += bytes_of(stage.image);
  return sum;
}

std::size_t bytes_of(const DecodedFrame& decoded) {
  std::size_t sum = 0;
  for (const cv::Mat& plane : decoded.frame.planes) sum += bytes_of(plane);
  return sum;
}

}  // namespace sigs::editor
