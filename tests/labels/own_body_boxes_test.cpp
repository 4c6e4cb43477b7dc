// SPDX-License-Identifier: MIT
#include "labels/own_body_boxes.h"

#include <doctest/doctest.h>

#include <opencv2/imgproc.hpp>
#include <vector>

namespace sigs::test {
namespace {

cv::Mat empty_mask() {
  return cv::Mat::zeros(480, 640, CV_32FC1);
}

// Share of the boxes' area that is body.
double filled(const cv::Mat& mask, const std::vector<cv::Rect>& boxes) {
  double body = 0;
  double area = 0;
  for (const cv::Rect& box : boxes) {
    body += cv::countNonZero(mask(box) >= 0.5);
    area += box.area();
  }
  return body / area;
}

// How many boxes hold each pixel.
cv::Mat counted(const std::vector<cv::Rect>& boxes) {
  cv::Mat count = cv::Mat::zeros(480, 640, CV_32SC1);
  for (const cv::Rect& box : boxes) count(box) += 1;
  return count;
}

}  // namespace

TEST_CASE("no own body has no boxes") {
  CHECK(own_body_boxes({}).empty());
  CHECK(own_body_boxes(empty_mask()).empty());
}

TEST_CASE("a rectangle is its own box, with what is more than half hidden") {
  cv::Mat mask = empty_mask();
  mask(cv::Rect(0, 400, 640, 80)) = 0.5;
  mask(cv::Rect(0, 390, 640, 10)) = 0.49;
  CHECK(own_body_boxes(mask) == std::vector<cv::Rect>{{0, 400, 640, 80}});
  cv::Mat pixel = empty_mask();
  pixel.at<float>(479, 639) = 1;
  CHECK(own_body_boxes(pixel) == std::vector<cv::Rect>{{639, 479, 1, 1}});
}

TEST_CASE("parts far from each other do not share a box") {
  cv::Mat mask = empty_mask();
  mask(cv::Rect(0, 0, 30, 480)) = 1;
  mask(cv::Rect(600, 0, 40, 480)) = 1;
  CHECK(own_body_boxes(mask) == std::vector<cv::Rect>{{0, 0, 30, 480}, {600, 0, 40, 480}});
}

TEST_CASE("every pixel of a body lies in exactly one box and little else does") {
  cv::Mat strut = empty_mask();
  cv::line(strut, {0, 0}, {639, 479}, cv::Scalar(1), 30);
  cv::Mat ring = empty_mask();
  cv::ellipse(ring, {320, 240}, {300, 220}, 0, 0, 360, cv::Scalar(1), 40);
  for (const cv::Mat& mask : {strut, ring}) {
    const std::vector<cv::Rect> boxes = own_body_boxes(mask);
    CHECK(boxes.size() > 4);
    CHECK(boxes.size() < 100);
    const cv::Mat count = counted(boxes);
    cv::Mat outside;
    cv::bitwise_and(mask >= 0.5, count != 1, outside);
    CHECK(cv::countNonZero(outside) == 0);
    CHECK(filled(mask, boxes) > 0.6);  // one box around either is filled by less than a third
  }
}

}  // namespace sigs::test
