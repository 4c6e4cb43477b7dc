// SPDX-License-Identifier: MIT
#include "compositor/replace.h"

#include "base/ensure.h"
#include "compositor/plane_writer.h"

namespace sigs {

namespace {

struct MixedRow {
  const cv::Vec3b* bgr;
  const float* weights;
  int left;

  [[nodiscard]] float opacity(int x) const { return weights[x - left]; }

  [[nodiscard]] cv::Vec3f over(int x, const cv::Vec3f& below) const {
    const cv::Vec3b& pixel = bgr[x - left];
    const cv::Vec3f rgb(pixel[2] / 255.0F, pixel[1] / 255.0F, pixel[0] / 255.0F);
    const float share = weights[x - left];
    return rgb * share + below * (1 - share);
  }
};

struct MixedPixels {
  const cv::Rect& rect;
  const cv::Mat& bgr;
  const cv::Mat& weight;

  [[nodiscard]] MixedRow row(int y) const {
    return {bgr.ptr<cv::Vec3b>(y - rect.y), weight.ptr<float>(y - rect.y), rect.x};
  }
};

}  // namespace

std::int64_t replace_pixels(Frame& frame, const cv::Rect& rect, const cv::Mat& bgr, const cv::Mat& weight) {
  ENSURE((rect & cv::Rect({0, 0}, frame.size_px())) == rect);
  ENSURE(bgr.type() == CV_8UC3 && bgr.size() == rect.size());
  ENSURE(weight.type() == CV_32FC1 && weight.size() == rect.size());
  return PlaneWriter(frame).rewrite(rect, MixedPixels{rect, bgr, weight});
}

std::int64_t replace_pixels(Frame& frame, const cv::Mat& bgr, const cv::Mat& weight) {
  return replace_pixels(frame, {{0, 0}, frame.size_px()}, bgr, weight);
}

}  // namespace sigs
