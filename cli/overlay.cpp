// SPDX-License-Identifier: MIT
#include "cli/overlay.h"

namespace sigs::cli {

namespace {

const cv::Vec3b kTint(255, 0, 255);  // magenta: neither sky nor ground nor paint
constexpr double kStrength = 0.5;

}  // namespace

cv::Mat tinted(const cv::Mat& bgr, const cv::Mat& mask) {
  cv::Mat picture = bgr.clone();
  for (int y = 0; y < picture.rows; ++y)
    for (int x = 0; x < picture.cols; ++x) {
      const double share = kStrength * mask.at<uchar>(y, x) / 255.0;
      cv::Vec3b& pixel = picture.at<cv::Vec3b>(y, x);
      for (int i = 0; i < 3; ++i) pixel[i] = cv::saturate_cast<uchar>(pixel[i] + share * (kTint[i] - pixel[i]));
    }
  return picture;
}

}  // namespace sigs::cli
