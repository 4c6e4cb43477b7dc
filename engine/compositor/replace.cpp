// SPDX-License-Identifier: MIT
#include "compositor/replace.h"

#include "base/ensure.h"
#include "compositor/plane_writer.h"

namespace sigs {

void replace_pixels(Frame& frame, const cv::Mat& bgr, const cv::Mat& weight) {
  ENSURE(bgr.type() == CV_8UC3 && bgr.size() == frame.size_px());
  ENSURE(weight.type() == CV_32FC1 && weight.size() == frame.size_px());
  const auto changed = [&weight](int x, int y) { return weight.at<float>(y, x) > 0; };
  const auto mixed = [&](int x, int y, const cv::Vec3f& below) -> cv::Vec3f {
    const cv::Vec3b& pixel = bgr.at<cv::Vec3b>(y, x);
    const cv::Vec3f rgb(pixel[2] / 255.0F, pixel[1] / 255.0F, pixel[0] / 255.0F);
    const float share = weight.at<float>(y, x);
    return rgb * share + below * (1 - share);
  };
  PixelBlocks(frame).rewrite(cv::Rect({0, 0}, frame.size_px()), changed, mixed);
}

}  // namespace sigs
