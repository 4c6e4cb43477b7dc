// SPDX-License-Identifier: MIT
#include "occlusion/detect.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "occlusion/synthetic_masks.h"

namespace sigs::test {

namespace {

constexpr float kInfinite = std::numeric_limits<float>::infinity();

float nearest_px(const cv::Mat& mask, int x, int y, bool in_mask) {
  double nearest = kInfinite;
  for (int v = 0; v < mask.rows; ++v)
    for (int u = 0; u < mask.cols; ++u)
      if ((mask.at<uchar>(v, u) != 0) == in_mask) nearest = std::min(nearest, std::hypot(u - x, v - y));
  return static_cast<float>(nearest);
}

// Square roots of whole numbers in single precision: up to the last digit.
bool same_distance(float a_px, float b_px) {
  return a_px == b_px || std::abs(a_px - b_px) <= 1e-6F * std::abs(b_px);
}

// The body's border is the straight line x = 10, between the pixels 9 and 10.
cv::Mat body_on_the_right() {
  cv::Mat mask = cv::Mat::zeros(8, 20, CV_8UC1);
  mask(cv::Rect(10, 0, 10, 8)).setTo(255);
  return mask;
}

}  // namespace

TEST_CASE("the distance of every pixel from the mask is that of a search through all pixels") {
  for (const cv::Size size : small_sizes())
    for (const double share : {0.0, 0.01, 0.5, 1.0}) {
      const cv::Mat mask = sprinkled(size, share, 3);
      const cv::Mat found = distance_px(mask);
      const cv::Mat from_border = signed_distance_px(mask);
      for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x) {
          const bool inside = mask.at<uchar>(y, x) != 0;
          const float to_other = nearest_px(mask, x, y, !inside);
          REQUIRE(same_distance(found.at<float>(y, x), nearest_px(mask, x, y, true)));
          REQUIRE(same_distance(from_border.at<float>(y, x), inside ? to_other - 0.5F : 0.5F - to_other));
        }
    }
}

TEST_CASE("a soft edge is centred on the border, as wide as asked for and linear in between") {
  for (const double width_px : {1.5, 2.0, 3.0, 4.0, 7.3}) {
    const cv::Mat soft = soft_edged(body_on_the_right(), width_px);
    for (int x = 0; x < 20; ++x) {
      const double inward_px = x + 0.5 - 10;
      const double expected = std::clamp(0.5 + inward_px / width_px, 0.0, 1.0) * 255;
      for (int y = 0; y < 8; ++y)  // up to the rounding of 8 bits
        REQUIRE(std::abs(soft.at<uchar>(y, x) - expected) <= 0.5 + 1e-3);
    }
  }
}

TEST_CASE("the edge is as soft along a slanted border as along a column") {
  cv::Mat mask = cv::Mat::zeros(60, 60, CV_8UC1);
  for (int y = 0; y < 60; ++y)
    for (int x = 0; x < 60; ++x)
      if (x + y >= 60) mask.at<uchar>(y, x) = 255;
  const cv::Mat soft = soft_edged(mask, 8);
  for (int x = 20; x < 40; ++x)
    for (int y = 20; y < 40; ++y) {
      const double inward_px = (x + y - 59.5) / std::sqrt(2.0);
      // The border runs half a pixel from the last pixels' middles; along a slope these lie sqrt(1/2) / 2 off it.
      CHECK(std::abs(soft.at<uchar>(y, x) / 255.0 - std::clamp(0.5 + inward_px / 8, 0.0, 1.0)) < 0.15 / 8 + 0.5 / 255);
    }
}

TEST_CASE("a body that touches the image's border does not fade there") {
  const cv::Mat soft = soft_edged(body_on_the_right(), 6);
  for (int y = 0; y < 8; ++y) CHECK(soft.at<uchar>(y, 19) == 255);
  for (int x = 0; x < 20; ++x) {
    CHECK(soft.at<uchar>(0, x) == soft.at<uchar>(4, x));
    CHECK(soft.at<uchar>(7, x) == soft.at<uchar>(4, x));
  }
}

TEST_CASE("a softness of zero or below a pixel keeps the mask hard") {
  const cv::Mat mask = sprinkled({30, 20}, 0.4, 5);
  for (const double width_px : {0.0, 0.5, 1.0}) CHECK(same_bytes(soft_edged(mask, width_px), mask));
}

TEST_CASE("a mask without an edge is unchanged, however soft") {
  for (const cv::Size size : small_sizes())
    for (const double width_px : {0.0, 2.0, 1000.0, 1e7})
      for (const int value : {0, 255}) {
        const cv::Mat mask(size, CV_8UC1, cv::Scalar(value));
        REQUIRE(same_bytes(soft_edged(mask, width_px), mask));
      }
}

TEST_CASE("a softness far wider than the image leaves it half grey") {
  const cv::Mat soft = soft_edged(body_on_the_right(), 1e7);
  double minimum = 0;
  double maximum = 0;
  cv::minMaxLoc(soft, &minimum, &maximum);
  CHECK(minimum >= 127);
  CHECK(maximum <= 128);
}

}  // namespace sigs::test
