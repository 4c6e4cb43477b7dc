// SPDX-License-Identifier: MIT
#include "labels/own_body_parts.h"

#include <doctest/doctest.h>

namespace sigs::test {

TEST_CASE("without an own body there are no parts") {
  CHECK(own_body_parts({}).empty());
  CHECK(own_body_parts(cv::Mat::zeros(48, 64, CV_32FC1)).empty());
}

TEST_CASE("what does not hang together is parts of their own, the largest first") {
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

TEST_CASE("a part's mask holds that part alone, also where another reaches into its box") {
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

TEST_CASE("specks of less than a ten thousandth of the image are left out") {
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

}  // namespace sigs::test
