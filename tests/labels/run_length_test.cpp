// SPDX-License-Identifier: MIT
#include "labels/run_length.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <random>

namespace sigs::test {
namespace {

// Reads COCO's string with the rules told backwards: numbers end at characters below 80, their sign is in the last one.
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

TEST_CASE("counts are the characters that the format's rules give by hand") {
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

TEST_CASE("any mask comes back from its counts") {
  std::mt19937 random(6);
  for (const cv::Size image : {cv::Size(1, 1), cv::Size(1, 9), cv::Size(9, 1), cv::Size(13, 7), cv::Size(200, 150)})
    for (const int percent : {0, 3, 50, 97, 100})
      check_comes_back(random_mask(image, percent, random), {{0, 0}, image}, image);
}

TEST_CASE("a mask of a box lies where the box lies") {
  std::mt19937 random(7);
  const cv::Size image(40, 30);
  for (int k = 0; k < 200; ++k) {
    const cv::Rect box =
        cv::Rect(int(random() % 40), int(random() % 30), 1 + int(random() % 20), 1 + int(random() % 20)) &
        cv::Rect({0, 0}, image);
    check_comes_back(random_mask(box.size(), 60, random), box, image);
  }
}

TEST_CASE("one pixel in each corner of the image comes back") {
  const cv::Mat pixel(1, 1, CV_8UC1, cv::Scalar(255));
  const cv::Size image(1920, 1080);
  for (const cv::Point corner : {cv::Point(0, 0), {1919, 0}, {0, 1079}, {1919, 1079}})
    check_comes_back(pixel, {corner, cv::Size(1, 1)}, image);
}

}  // namespace sigs::test
