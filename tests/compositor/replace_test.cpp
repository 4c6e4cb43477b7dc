// SPDX-License-Identifier: MIT
#include "compositor/replace.h"

#include <doctest/doctest.h>

#include <cmath>

#include "compositor/synthetic_frames.h"
#include "compositor/synthetic_layers.h"

namespace sigs::test {

TEST_CASE("an image replaces whole blocks by its own code values") {
  for (const Sort& sort : all_sorts()) {
    CAPTURE(sort.name);
    Frame frame = grainy(sort, {11, 9});
    const cv::Vec3b bgr(180, 40, 220);
    const cv::Vec3d wanted = codes_of(sort, {220 / 255.0, 40 / 255.0, 180 / 255.0});
    replace_pixels(frame, cv::Mat(9, 11, CV_8UC3, cv::Scalar(bgr)), cv::Mat(9, 11, CV_32FC1, cv::Scalar(1)));
    for (int plane = 0; plane < frame.plane_count(); ++plane) {
      const cv::Mat& codes = frame.planes[static_cast<std::size_t>(plane)];
      for (int y = 0; y < codes.rows; ++y)
        for (int x = 0; x < codes.cols; ++x)
          REQUIRE(std::abs(codes.at<uchar>(y, x) - std::min(wanted[plane], 255.0)) < 0.501);  // rounding
    }
  }
}

TEST_CASE("an image leaves what has no weight and mixes code values between") {
  for (const Sort& sort : all_sorts()) {
    CAPTURE(sort.name);
    Frame frame = grainy(sort, {12, 8});
    const Frame before = cloned(frame);
    cv::Mat weight = cv::Mat::zeros(8, 12, CV_32FC1);
    weight(cv::Rect(4, 4, 2, 2)).setTo(0.25);
    replace_pixels(frame, cv::Mat(8, 12, CV_8UC3, cv::Scalar::all(255)), weight);
    for (int y = 0; y < 8; ++y)
      for (int x = 0; x < 12; ++x) {
        const double old_code = before.planes[0].at<uchar>(y, x);
        const bool inside = cv::Rect(4, 4, 2, 2).contains({x, y});
        const double white = sort.is_limited ? 235 : 255;
        const double wanted = inside ? 0.75 * old_code + 0.25 * white : old_code;
        REQUIRE(std::abs(frame.planes[0].at<uchar>(y, x) - wanted) < 0.501);
      }
    const Layer covered = even_layer({4, 4, 2, 2}, {1, 1, 1, 1});
    for (int plane = 1; plane < frame.plane_count(); ++plane) {
      const cv::Mat& codes = frame.planes[static_cast<std::size_t>(plane)];
      for (int y = 0; y < codes.rows; ++y)
        for (int x = 0; x < codes.cols; ++x) {
          const int old_code = before.planes[static_cast<std::size_t>(plane)].at<uchar>(y, x);
          if (!is_covered(covered, x, y, plane, sort, {12, 8})) REQUIRE(int(codes.at<uchar>(y, x)) == old_code);
        }
    }
  }
}

TEST_CASE("no weight at all leaves every bit") {
  for (const Sort& sort : all_sorts()) {
    Frame frame = grainy(sort, {13, 7});
    const Frame before = cloned(frame);
    replace_pixels(frame, cv::Mat(7, 13, CV_8UC3, cv::Scalar::all(255)), cv::Mat::zeros(7, 13, CV_32FC1));
    for (int plane = 0; plane < frame.plane_count(); ++plane)
      CHECK(same_bytes(frame.planes[static_cast<std::size_t>(plane)], before.planes[static_cast<std::size_t>(plane)]));
  }
}

}  // namespace sigs::test
