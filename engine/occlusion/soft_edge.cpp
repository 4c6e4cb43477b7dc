// SPDX-License-Identifier: MIT
#include "occlusion/soft_edge.h"

#include <limits>
#include <opencv2/imgproc.hpp>

#include "base/ensure.h"

namespace sigs {

cv::Mat distance_px(const cv::Mat& mask) {
  ENSURE(mask.type() == CV_8UC1 && !mask.empty());
  if (cv::countNonZero(mask) == 0) return {mask.size(), CV_32FC1, cv::Scalar(std::numeric_limits<float>::infinity())};
  cv::Mat out;
  cv::distanceTransform(mask == 0, out, cv::DIST_L2, cv::DIST_MASK_PRECISE, CV_32F);
  return out;
}

cv::Mat signed_distance_px(const cv::Mat& mask) {
  constexpr double kMiddleToBorder_px = 0.5;
  cv::Mat inside = distance_px(mask == 0) - kMiddleToBorder_px;
  const cv::Mat outside = kMiddleToBorder_px - distance_px(mask);
  outside.copyTo(inside, mask == 0);
  return inside;
}

cv::Mat soft_edged(const cv::Mat& mask, double width_px) {
  ENSURE(width_px >= 0);
  if (width_px <= 1) return mask != 0;
  cv::Mat inward_px = signed_distance_px(mask);
  cv::min(inward_px, width_px, inward_px);  // infinity has no 8-bit value
  cv::max(inward_px, -width_px, inward_px);
  cv::Mat out;
  inward_px.convertTo(out, CV_8U, 255 / width_px, 0.5 * 255);
  return out;
}

}  // namespace sigs
