// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>
#include <vector>

namespace sigs {

// Memory of large images, kept from frame to frame: the system clears what it gives out anew, page by page, which takes
// as long as filling the image. A buffer is given out again once no image shares it any more; one that is much larger
// than what is asked for is freed. Belongs to one thread, and so do its images.
class BufferPool {
 public:
  // An image of floats, of any number of channels, whose samples are what they happen to be. The size is not empty.
  [[nodiscard]] cv::Mat image(const cv::Size& size, int type);

 private:
  std::vector<cv::Mat> buffers_;  // CV_32FC1, one row each
};

}  // namespace sigs
