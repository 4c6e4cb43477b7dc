// SPDX-License-Identifier: MIT
#include "cli/overlay.h"

namespace sigs::cli {

namespace {

const cv::Vec3b kTint(255, 0, 255);  // magenta: neither sky nor ground nor paint
constexpr double kStrength = 0.5;

}  // namespace

cv::Mat tinted(const cv::Mat& bgr, const cv::Mat& mask) {
  cv::Mat image = bgr.clone();
  for (int y = 0; y < image.rows; ++y)
    for (int x = 0; x < image.cols; ++x) {
      const double share = kStrength * mask.at<uchar>(y, x) / 255.0;
      cv::Vec3b& pixel = image.at<cv::Vec3b>(y, x);
      for (int i = 0; i < 3; ++i) pixel[i] = cv::saturate_cast<uchar>(pixel[i] + share * (kTint[i] - pixel[i]));
    }
  return image;
}

}  // namespace sigs::cli
