// SPDX-License-Identifier: MIT
#include "occlusion/mask_geometry.h"

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
  constexpr double kCenterToBorder_px = 0.5;
  cv::Mat inside = distance_px(mask == 0) - kCenterToBorder_px;
  const cv::Mat outside = kCenterToBorder_px - distance_px(mask);
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

cv::Mat disc(int radius) {
  return cv::getStructuringElement(cv::MORPH_ELLIPSE, {2 * radius + 1, 2 * radius + 1});
}

double intersection_over_union(const cv::Mat& a, const cv::Mat& b) {
  ENSURE(a.type() == CV_8UC1 && b.type() == CV_8UC1 && a.size() == b.size());
  constexpr double kHalf = 128;
  const cv::Mat in_a = a >= kHalf;
  const cv::Mat in_b = b >= kHalf;
  const int either = cv::countNonZero(in_a | in_b);
  return either == 0 ? 1.0 : static_cast<double>(cv::countNonZero(in_a & in_b)) / either;
}

}  // namespace sigs
