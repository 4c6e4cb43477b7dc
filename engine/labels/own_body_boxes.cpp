// SPDX-License-Identifier: MIT
#include "labels/own_body_boxes.h"

#include <algorithm>

namespace sigs {

namespace {

constexpr double kFilled = 0.75;
constexpr int kMinPartShare = 16;  // of the image's longer side

bool any(const cv::Mat& part) {
  return cv::countNonZero(part) > 0;
}

cv::Rect shrunk(const cv::Mat& body, cv::Rect box) {
  while (box.height > 0 && !any(body(box).row(0))) box = {box.x, box.y + 1, box.width, box.height - 1};
  while (box.height > 0 && !any(body(box).row(box.height - 1))) --box.height;
  while (!box.empty() && !any(body(box).col(0))) box = {box.x + 1, box.y, box.width - 1, box.height};
  while (!box.empty() && !any(body(box).col(box.width - 1))) --box.width;
  return box;
}

// body: CV_8UC1, not 0 where the body is.
void add_boxes(const cv::Mat& body, const cv::Rect& within, std::vector<cv::Rect>& boxes) {
  const cv::Rect box = shrunk(body, within);
  if (box.empty()) return;
  const double filled = cv::countNonZero(body(box)) / static_cast<double>(box.area());
  const int min_part_px = std::max(2, std::max(body.cols, body.rows) / kMinPartShare);
  if (filled >= kFilled || std::max(box.width, box.height) <= min_part_px) return boxes.push_back(box);
  cv::Rect low = box;
  cv::Rect high = box;
  if (box.width >= box.height) {
    low.width = box.width / 2;
    high.x += low.width;
    high.width -= low.width;
  } else {
    low.height = box.height / 2;
    high.y += low.height;
    high.height -= low.height;
  }
  add_boxes(body, low, boxes);
  add_boxes(body, high, boxes);
}

}  // namespace

std::vector<cv::Rect> own_body_boxes(const cv::Mat& mask) {
  std::vector<cv::Rect> boxes;
  if (mask.empty()) return boxes;
  const cv::Mat body = mask >= 0.5;
  add_boxes(body, {0, 0, body.cols, body.rows}, boxes);
  return boxes;
}

}  // namespace sigs
