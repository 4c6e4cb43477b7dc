// SPDX-License-Identifier: MIT
#include "occlusion/synthetic_masks.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <opencv2/imgproc.hpp>

namespace sigs::test {

cv::Mat drawn(std::initializer_list<std::string_view> rows) {
  cv::Mat out = cv::Mat::zeros(static_cast<int>(rows.size()), static_cast<int>(rows.begin()->size()), CV_8UC1);
  int y = 0;
  for (const std::string_view row : rows) {
    REQUIRE(static_cast<int>(row.size()) == out.cols);
    for (int x = 0; x < out.cols; ++x)
      if (row[static_cast<std::size_t>(x)] == '#') out.at<uchar>(y, x) = 255;
    ++y;
  }
  return out;
}

cv::Mat sprinkled(cv::Size size_px, double share, std::uint64_t seed) {
  cv::RNG chance(seed);
  cv::Mat draw(size_px, CV_64FC1);
  chance.fill(draw, cv::RNG::UNIFORM, 0.0, 1.0);
  return draw < share;
}

cv::Mat hills(cv::Size size_px, double width_px, std::uint64_t seed) {
  cv::RNG chance(seed);
  cv::Mat noise(size_px, CV_32FC1);
  chance.fill(noise, cv::RNG::NORMAL, 0.0, 1.0);
  cv::GaussianBlur(noise, noise, {}, width_px);
  cv::normalize(noise, noise, 0, 255, cv::NORM_MINMAX);
  cv::Mat out;
  noise.convertTo(out, CV_8U);
  return out;
}

bool same_bytes(const cv::Mat& a, const cv::Mat& b) {
  if (a.size() != b.size() || a.type() != b.type()) return false;
  for (int y = 0; y < a.rows; ++y)
    if (!std::equal(a.ptr(y), a.ptr(y) + a.cols * a.elemSize(), b.ptr(y))) return false;
  return true;
}

std::vector<cv::Size> small_sizes() {
  return {{1, 1}, {1, 9}, {9, 1}, {2, 2}, {7, 5}, {31, 23}, {48, 36}};
}

}  // namespace sigs::test
