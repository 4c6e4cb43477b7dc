// SPDX-License-Identifier: MIT
#include "labels/label_files.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <opencv2/imgproc.hpp>
#include <random>
#include <vector>

namespace sigs::test {

TEST_CASE("without an own body there are no parts") {
  CHECK(own_body_parts({}).empty());
  CHECK(own_body_parts(cv::Mat::zeros(48, 64, CV_32FC1)).empty());
}

TEST_CASE("components that do not touch are separate parts, the largest first") {
  cv::Mat body = cv::Mat::zeros(48, 64, CV_32FC1);
  body(cv::Rect(0, 40, 10, 8)).setTo(1);
  body(cv::Rect(50, 30, 14, 18)).setTo(1);
  const std::vector<OwnBodyPart> parts = own_body_parts(body);
  REQUIRE(parts.size() == 2);
  CHECK(parts[0].box == cv::Rect(50, 30, 14, 18));
  CHECK(parts[0].pixels == 14 * 18);
  CHECK(parts[1].box == cv::Rect(0, 40, 10, 8));
  CHECK(cv::countNonZero(parts[1].mask) == 80);
}

TEST_CASE("a part's mask contains that part alone, also where another one extends into its box") {
  cv::Mat body = cv::Mat::zeros(40, 40, CV_32FC1);
  body(cv::Rect(0, 0, 40, 2)).setTo(1);  // an L around a square
  body(cv::Rect(0, 0, 2, 40)).setTo(1);
  body(cv::Rect(10, 10, 5, 5)).setTo(1);
  const std::vector<OwnBodyPart> parts = own_body_parts(body);
  REQUIRE(parts.size() == 2);
  CHECK(parts[0].box == cv::Rect(0, 0, 40, 40));
  CHECK(parts[0].pixels == 80 + 76);
  CHECK(cv::countNonZero(parts[0].mask) == 80 + 76);
  CHECK(parts[0].mask.at<unsigned char>(12, 12) == 0);
}

TEST_CASE("corners join, half opacity counts and less does not") {
  cv::Mat body = cv::Mat::zeros(20, 20, CV_32FC1);
  body.at<float>(5, 5) = 0.5F;
  body.at<float>(6, 6) = 1;
  body.at<float>(7, 7) = 0.49F;
  const std::vector<OwnBodyPart> parts = own_body_parts(body);
  REQUIRE(parts.size() == 1);
  CHECK(parts[0].box == cv::Rect(5, 5, 2, 2));
  CHECK(parts[0].pixels == 2);
}

TEST_CASE("parts of less than a ten thousandth of the image are left out") {
  cv::Mat body = cv::Mat::zeros(200, 300, CV_32FC1);  // 6 px are a ten thousandth
  body(cv::Rect(0, 0, 5, 1)).setTo(1);
  body(cv::Rect(100, 100, 6, 1)).setTo(1);
  const std::vector<OwnBodyPart> parts = own_body_parts(body);
  REQUIRE(parts.size() == 1);
  CHECK(parts[0].box == cv::Rect(100, 100, 6, 1));
}

TEST_CASE("a body that fills the image is one part") {
  const std::vector<OwnBodyPart> parts = own_body_parts(cv::Mat::ones(48, 64, CV_32FC1));
  REQUIRE(parts.size() == 1);
  CHECK(parts[0].box == cv::Rect(0, 0, 64, 48));
  CHECK(parts[0].pixels == 64 * 48);
}

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

// Number of boxes that contain each pixel.
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

namespace {

// Reads COCO's string with the rules inverted: numbers end at characters below 80, their sign is in the last one.
std::vector<std::int64_t> runs_read(const std::string& text) {
  std::vector<std::int64_t> runs;
  std::string number;
  for (const char c : text) {
    number += c;
    if (c >= 'P') continue;
    std::int64_t value = c >= '@' ? c - '0' - 32 : c - '0';
    for (std::size_t i = number.size() - 1; i-- > 0;) value = value * 32 + (number[i] - 'P');
    if (runs.size() > 2) value += runs[runs.size() - 2];
    runs.push_back(value);
    number.clear();
  }
  CHECK(number.empty());
  return runs;
}

// Pixel by pixel, down the columns.
cv::Mat mask_read(const std::vector<std::int64_t>& runs, cv::Size image) {
  cv::Mat mask = cv::Mat::zeros(image, CV_8UC1);
  int at = 0;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    REQUIRE(at + runs[i] <= image.area());
    for (std::int64_t k = 0; k < runs[i]; ++k, ++at)
      mask.at<unsigned char>(at % image.height, at / image.height) = i % 2 == 1 ? 255 : 0;
  }
  CHECK(at == image.area());
  return mask;
}

void check_comes_back(const cv::Mat& mask, const cv::Rect& box, cv::Size image) {
  cv::Mat whole = cv::Mat::zeros(image, CV_8UC1);
  mask.copyTo(whole(box));
  const std::vector<std::uint32_t> runs = column_runs(mask, box, image);
  const std::vector<std::int64_t> read = runs_read(coco_counts(runs));
  CHECK(std::equal(runs.begin(), runs.end(), read.begin(), read.end()));
  CHECK(cv::countNonZero(mask_read(read, image) != whole) == 0);
  CHECK(std::find(runs.begin() + 1, runs.end(), 0U) == runs.end());
}

cv::Mat random_mask(cv::Size size, int percent, std::mt19937& random) {
  cv::Mat mask(size, CV_8UC1);
  for (int j = 0; j < size.height; ++j)
    for (int i = 0; i < size.width; ++i) mask.at<unsigned char>(j, i) = int(random() % 100) < percent ? 255 : 0;
  return mask;
}

std::vector<std::uint32_t> runs_of_column(const std::vector<int>& pixels) {
  cv::Mat mask(static_cast<int>(pixels.size()), 1, CV_8UC1);
  for (int j = 0; j < mask.rows; ++j)
    mask.at<unsigned char>(j, 0) = static_cast<unsigned char>(pixels[static_cast<std::size_t>(j)]);
  return column_runs(mask, {{0, 0}, mask.size()}, mask.size());
}

}  // namespace

TEST_CASE("runs are those that COCO's documentation gives for its examples") {
  CHECK(runs_of_column({0, 0, 1, 1, 1, 0, 1}) == std::vector<std::uint32_t>{2, 3, 1, 1});
  CHECK(runs_of_column({1, 1, 1, 1, 1, 1, 0}) == std::vector<std::uint32_t>{0, 6, 1});
}

TEST_CASE("counts are the characters derived manually from the format's rules") {
  const auto counts = [](const std::vector<std::uint32_t>& runs) { return coco_counts(runs); };
  CHECK(counts({2, 3, 1, 1}) == "231N");     // the last is 1 - 3 = -2: bits 11110, 30, and 48 + 30 is N
  CHECK(counts({307200}) == "PP\\9");        // 0, 0, 12 and 9 as digits of base 32; all but the last have 32 added
  CHECK(counts({15}) == "?");                // 01111 ends at once
  CHECK(counts({16}) == "`0");               // 10000 would read as negative, so a 0 follows
  CHECK(counts({0, 16, 0, 0}) == "0`00@");   // -16: 10000 alone
  CHECK(counts({0, 17, 0, 0}) == "0a00_O");  // -17: 01111 would read as positive, so a 31 follows
}

TEST_CASE("runs go down columns and not along rows") {
  cv::Mat mask = cv::Mat::zeros(2, 3, CV_8UC1);
  mask.at<unsigned char>(0, 1) = 255;
  mask.at<unsigned char>(1, 1) = 255;
  CHECK(column_runs(mask, {0, 0, 3, 2}, {3, 2}) == std::vector<std::uint32_t>{2, 2, 2});
}

TEST_CASE("any mask is recovered from its counts") {
  std::mt19937 random(6);
  for (const cv::Size image : {cv::Size(1, 1), cv::Size(1, 9), cv::Size(9, 1), cv::Size(13, 7), cv::Size(200, 150)})
    for (const int percent : {0, 3, 50, 97, 100})
      check_comes_back(random_mask(image, percent, random), {{0, 0}, image}, image);
}

TEST_CASE("a mask of a box is placed at the box") {
  std::mt19937 random(7);
  const cv::Size image(40, 30);
  for (int k = 0; k < 200; ++k) {
    const cv::Rect box =
        cv::Rect(int(random() % 40), int(random() % 30), 1 + int(random() % 20), 1 + int(random() % 20)) &
        cv::Rect({0, 0}, image);
    check_comes_back(random_mask(box.size(), 60, random), box, image);
  }
}

TEST_CASE("one pixel in each corner of the image is read back") {
  const cv::Mat pixel(1, 1, CV_8UC1, cv::Scalar(255));
  const cv::Size image(1920, 1080);
  for (const cv::Point corner : {cv::Point(0, 0), {1919, 0}, {0, 1079}, {1919, 1079}})
    check_comes_back(pixel, {corner, cv::Size(1, 1)}, image);
}

}  // namespace sigs::test
