// SPDX-License-Identifier: MIT
#include "occlusion/body_parts.h"

#include <algorithm>
#include <cstdint>
#include <opencv2/imgproc.hpp>
#include <vector>

namespace sigs {

namespace {

// Between what parts of aircraft and other parts of the picture show in made and real films.
constexpr double kLeastWalled = 0.74;  // of the rim, by edges or ends of motion; creeping sky 0.73 at most
constexpr double kLeastEdged = 0.63;   // likewise, ends of motion counting half; body 0.65, sky between trees 0.61
constexpr double kMostVariation = 5;   // times noise, the median inside; body 3.5, road and clouds 6
constexpr double kMostDrift = 0.2;     // the mean inside; body 0.16
constexpr int kRimShare = 160;         // of the width: that far inside the rim, what passes outside still shows

cv::Mat square(int reach) {
  return cv::Mat::ones(2 * reach + 1, 2 * reach + 1, CV_8UC1);
}

double median(const cv::Mat& values, const cv::Mat& mask) {
  std::vector<float> sorted;
  for (int y = 0; y < values.rows; ++y)
    for (int x = 0; x < values.cols; ++x)
      if (mask.at<std::uint8_t>(y, x) != 0) sorted.push_back(values.at<float>(y, x));
  if (sorted.empty()) return 0;
  const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
  std::nth_element(sorted.begin(), middle, sorted.end());
  return *middle;
}

// The walls' middles may lie on either side of the labels' border.
struct Rim {
  cv::Mat walled;
  cv::Mat edged;
};

Rim rim_evidence(const PartEvidence& evidence) {
  cv::Mat staying;
  cv::Mat ending;
  cv::dilate(evidence.staying, staying, square(1));
  cv::dilate(evidence.ending, ending, square(3));
  const cv::Mat walled = cv::max(staying, ending);
  return {walled, (walled + staying) * 0.5};
}

bool is_walled_off(const cv::Mat& part, const Rim& evidence) {
  cv::Mat rim;
  cv::dilate(part, rim, square(1));
  rim -= part;
  if (cv::countNonZero(rim) == 0) return true;
  return cv::mean(evidence.walled, rim)[0] >= kLeastWalled && cv::mean(evidence.edged, rim)[0] >= kLeastEdged;
}

bool is_still(const cv::Mat& part, const PartEvidence& evidence) {
  cv::Mat inside;
  cv::erode(part, inside, square(std::max(1, part.cols / kRimShare)));
  return median(evidence.variation, inside) <= kMostVariation && cv::mean(evidence.drift, inside)[0] <= kMostDrift;
}

bool is_at_border(const cv::Rect& box, cv::Size size) {
  return box.x == 0 || box.y == 0 || box.br().x == size.width || box.br().y == size.height;
}

}  // namespace

BodyParts body_parts(const cv::Mat& labels, const PartEvidence& evidence, double least_area_px) {
  const Rim rim = rim_evidence(evidence);
  cv::Mat numbers;
  cv::Mat boxes;
  cv::Mat middles;
  const int count = cv::connectedComponentsWithStats(labels, numbers, boxes, middles, 8, CV_32S);
  BodyParts parts{cv::Mat::zeros(labels.size(), CV_8UC1), cv::Mat::zeros(labels.size(), CV_8UC1)};
  for (int i = 1; i < count; ++i) {
    const int* row = boxes.ptr<int>(i);
    if (row[cv::CC_STAT_AREA] < least_area_px) continue;
    const cv::Rect box(row[cv::CC_STAT_LEFT], row[cv::CC_STAT_TOP], row[cv::CC_STAT_WIDTH], row[cv::CC_STAT_HEIGHT]);
    const cv::Mat part = numbers == i;
    const bool is_body = is_at_border(box, labels.size()) && is_walled_off(part, rim) && is_still(part, evidence);
    (is_body ? parts.kept : parts.doubtful).setTo(255, part);
  }
  return parts;
}

}  // namespace sigs
