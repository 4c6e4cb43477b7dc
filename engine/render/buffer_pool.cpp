// SPDX-License-Identifier: MIT
#include "render/buffer_pool.h"

#include <algorithm>
#include <cstddef>

#include "base/ensure.h"

namespace sigs {

cv::Mat BufferPool::image(const cv::Size& size, int type) {
  ENSURE(CV_MAT_DEPTH(type) == CV_32F && !size.empty());
  constexpr std::size_t kMostTimesTooLarge = 4;  // an intruder that flies away gives its memory back
  const std::size_t floats = static_cast<std::size_t>(size.area()) * CV_MAT_CN(type);
  const auto is_free = [](const cv::Mat& buffer) { return buffer.u->refcount == 1; };
  auto found = std::find_if(buffers_.begin(), buffers_.end(), [&](const cv::Mat& buffer) {
    return is_free(buffer) && buffer.total() >= floats && buffer.total() <= kMostTimesTooLarge * floats;
  });
  if (found == buffers_.end()) {
    std::erase_if(buffers_, is_free);
    buffers_.emplace_back(1, static_cast<int>(floats + floats / 4), CV_32FC1);  // the next frame's may be larger
    found = buffers_.end() - 1;
  }
  cv::Mat image = found->colRange(0, static_cast<int>(floats)).reshape(CV_MAT_CN(type), size.height);
  // A whole image: of a part, OpenCV's filters would take what lies beyond its edges from the rest of the buffer.
  image.flags &= ~cv::Mat::SUBMATRIX_FLAG;
  image.dataend = image.datalimit = image.data + floats * sizeof(float);
  return image;
}

}  // namespace sigs
