// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "occlusion/paper.h"
#include "occlusion/synthetic_masks.h"

namespace sigs::test {

TEST_CASE("every difference counts one where it is largest") {
  for (const cv::Size size : small_sizes()) {
    cv::Mat sum = cv::Mat::zeros(size, CV_32FC1);
    cv::Mat expected = cv::Mat::zeros(size, CV_64FC1);
    for (int n = 0; n < 20; ++n) {
      cv::Mat difference = hills(size, 1, static_cast<std::uint64_t>(n)) / (n + 1);
      difference.at<uchar>(0, 0) = static_cast<uchar>(n + 1);  // never black
      REQUIRE(add_normalised(difference, sum));
      const double largest = *std::max_element(difference.begin<uchar>(), difference.end<uchar>());
      for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x) expected.at<double>(y, x) += difference.at<uchar>(y, x) / largest;
    }
    // Twenty roundings of single precision.
    for (int y = 0; y < size.height; ++y)
      for (int x = 0; x < size.width; ++x)
        REQUIRE(sum.at<float>(y, x) == doctest::Approx(expected.at<double>(y, x)).epsilon(20 * 1.2e-7));
  }
}

TEST_CASE("a black difference adds nothing and returns so") {
  cv::Mat sum(4, 5, CV_32FC1, cv::Scalar(0.25));
  CHECK_FALSE(add_normalised(cv::Mat::zeros(4, 5, CV_8UC1), sum));
  CHECK(cv::countNonZero(sum != 0.25F) == 0);
}

TEST_CASE("the normalised sum goes from 0 to 255") {
  cv::Mat sum = (cv::Mat_<float>(1, 5) << 3.0F, 4.0F, 5.0F, 7.0F, 3.5F);
  const cv::Mat found = normalised_sum(sum);
  const std::array<int, 5> expected = {0, 64, 128, 255, 32};  // (value - 3) / 4 * 255, rounded
  for (int x = 0; x < 5; ++x) CHECK(std::abs(found.at<uchar>(0, x) - expected[static_cast<std::size_t>(x)]) <= 1);
  CHECK(found.at<uchar>(0, 0) == 0);
  CHECK(found.at<uchar>(0, 3) == 255);
}

TEST_CASE("a sum of one value everywhere is black") {
  for (const double value : {0.0, 1e-30, 1.0, 1e7})
    for (const cv::Size size : small_sizes())
      CHECK(cv::countNonZero(normalised_sum(cv::Mat(size, CV_32FC1, cv::Scalar(value)))) == 0);
}

}  // namespace sigs::test
