// SPDX-License-Identifier: MIT
#include "labels/own_body_parts.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>
#include <tuple>

namespace sigs {

std::vector<OwnBodyPart> own_body_parts(const cv::Mat& own_body) {
  constexpr double kOccludes = 0.5;
  constexpr double kMinPart = 1e-4;  // of the image
  std::vector<OwnBodyPart> parts;
  if (own_body.empty()) return parts;
  cv::Mat labels;
  cv::Mat stats;
  cv::Mat centres;
  const int found = cv::connectedComponentsWithStats(own_body >= kOccludes, labels, stats, centres);
  const double min_pixels = kMinPart * static_cast<double>(own_body.total());
  for (int i = 1; i < found; ++i) {
    const cv::Rect box(stats.at<int>(i, cv::CC_STAT_LEFT), stats.at<int>(i, cv::CC_STAT_TOP),
                       stats.at<int>(i, cv::CC_STAT_WIDTH), stats.at<int>(i, cv::CC_STAT_HEIGHT));
    const int pixels = stats.at<int>(i, cv::CC_STAT_AREA);
    if (pixels >= min_pixels) parts.push_back({.box = box, .mask = labels(box) == i, .pixels = pixels});
  }
  std::sort(parts.begin(), parts.end(), [](const OwnBodyPart& a, const OwnBodyPart& b) {
    return std::tuple(-a.pixels, a.box.y, a.box.x) < std::tuple(-b.pixels, b.box.y, b.box.x);
  });
  return parts;
}

}  // namespace sigs
