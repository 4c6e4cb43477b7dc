// SPDX-License-Identifier: MIT
#include "occlusion/intersection.h"

#include "base/ensure.h"

namespace sigs {

double intersection_over_union(const cv::Mat& a, const cv::Mat& b) {
  ENSURE(a.type() == CV_8UC1 && b.type() == CV_8UC1 && a.size() == b.size());
  constexpr double kHalf = 128;
  const cv::Mat in_a = a >= kHalf;
  const cv::Mat in_b = b >= kHalf;
  const int either = cv::countNonZero(in_a | in_b);
  return either == 0 ? 1.0 : static_cast<double>(cv::countNonZero(in_a & in_b)) / either;
}

}  // namespace sigs
