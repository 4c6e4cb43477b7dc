// SPDX-License-Identifier: MIT
#include "occlusion/paper.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cstdlib>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "occlusion/synthetic_masks.h"

namespace sigs::test {

namespace {

// Whether a pixel of this value lies within the radius; only the image's own pixels count.
bool near(const cv::Mat& mask, int x, int y, double radius_px, bool value) {
  for (int v = 0; v < mask.rows; ++v)
    for (int u = 0; u < mask.cols; ++u)
      if ((mask.at<uchar>(v, u) != 0) == value && (u - x) * (u - x) + (v - y) * (v - y) <= radius_px * radius_px)
        return true;
  return false;
}

template <typename Rule>
cv::Mat by_pixels(cv::Size size, const Rule& is_white) {
  cv::Mat out = cv::Mat::zeros(size, CV_8UC1);
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x)
      if (is_white(x, y)) out.at<uchar>(y, x) = 255;
  return out;
}

cv::Mat dilated_by_loops(const cv::Mat& mask, int diameter_px) {
  return by_pixels(mask.size(), [&](int x, int y) { return near(mask, x, y, 0.5 * diameter_px, true); });
}

cv::Mat eroded_by_loops(const cv::Mat& mask, int diameter_px) {
  return by_pixels(mask.size(), [&](int x, int y) { return !near(mask, x, y, 0.5 * diameter_px, false); });
}

cv::Mat filled_by_opencv(const cv::Mat& mask) {
  std::vector<std::vector<cv::Point>> contours;
  cv::findContours(mask.clone(), contours, cv::RETR_EXTERNAL, cv::CHAIN_APPROX_NONE);
  cv::Mat out = cv::Mat::zeros(mask.size(), CV_8UC1);
  for (std::size_t i = 0; i < contours.size(); ++i)
    cv::drawContours(out, contours, static_cast<int>(i), cv::Scalar(255), cv::FILLED);
  return out;
}

cv::Mat sobel_by_loops(const cv::Mat& mask) {
  const auto sample = [&](int x, int y) -> int {
    return mask.at<uchar>(std::clamp(y, 0, mask.rows - 1), std::clamp(x, 0, mask.cols - 1));
  };
  return by_pixels(mask.size(), [&](int x, int y) {
    int across = 0;
    int down = 0;
    for (const int k : {-1, 0, 1}) {
      across += (2 - std::abs(k)) * (sample(x + 1, y + k) - sample(x - 1, y + k));
      down += (2 - std::abs(k)) * (sample(x + k, y + 1) - sample(x + k, y - 1));
    }
    return across != 0 || down != 0;
  });
}

// The pixels connected to this one, by sides and corners.
int size_of_part(const cv::Mat& mask, cv::Point start) {
  cv::Mat seen = cv::Mat::zeros(mask.size(), CV_8UC1);
  std::vector<cv::Point> open = {start};
  seen.at<uchar>(start) = 1;
  for (std::size_t i = 0; i < open.size(); ++i)
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx) {
        const cv::Point next = open[i] + cv::Point(dx, dy);
        if (!cv::Rect({}, mask.size()).contains(next) || mask.at<uchar>(next) == 0 || seen.at<uchar>(next) != 0)
          continue;
        seen.at<uchar>(next) = 1;
        open.push_back(next);
      }
  return static_cast<int>(open.size());
}

const std::vector<double> kShares = {0.0, 0.02, 0.2, 0.5, 0.8, 1.0};

}  // namespace

TEST_CASE("dilating and closing agree with loops over a disc") {
  for (const cv::Size size : small_sizes())
    for (const double share : {0.0, 0.02, 0.3, 1.0})
      for (const int diameter_px : {1, 2, 3, 5, 9, 1000}) {
        const cv::Mat mask = sprinkled(size, share, 11);
        const cv::Mat grown = dilated_by_loops(mask, diameter_px);
        REQUIRE(same_bytes(dilated(mask, diameter_px), grown));
        REQUIRE(same_bytes(closed(mask, diameter_px), eroded_by_loops(grown, diameter_px)));
      }
}

TEST_CASE("closing fills a gap narrower than its diameter and no wider one") {
  const cv::Mat bars = drawn({"##...####", "##...####", "##...####"});
  CHECK(cv::countNonZero(closed(bars, 4) == 0) == 0);
  CHECK(same_bytes(closed(bars, 2), bars));
}

TEST_CASE("filled contours are those OpenCV finds from outside and draws filled") {
  for (const cv::Size size : small_sizes())
    for (const double share : kShares)
      for (std::uint64_t seed = 0; seed < 5; ++seed) {
        const cv::Mat mask = sprinkled(size, share, seed);
        REQUIRE(same_bytes(contours_filled(mask), filled_by_opencv(mask)));
      }
}

TEST_CASE("a closed contour is filled with all it contains, one open towards the border is not") {
  CHECK(same_bytes(contours_filled(drawn({".......", ".#####.", ".#...#.", ".#.#.#.", ".#####."})),
                   drawn({".......", ".#####.", ".#####.", ".#####.", ".#####."})));
  const cv::Mat to_the_bottom = drawn({".......", ".#####.", ".#...#.", ".#...#."});
  CHECK(same_bytes(contours_filled(to_the_bottom), to_the_bottom));
  const cv::Mat by_corners = drawn({"..#..", ".#.#.", "..#.."});  // corners close: no way through between them
  CHECK(contours_filled(by_corners).at<uchar>(1, 2) == 255);
}

TEST_CASE("Sobel's edges are those of loops over three by three pixels") {
  for (const cv::Size size : small_sizes())
    for (const double share : kShares)
      for (std::uint64_t seed = 0; seed < 5; ++seed) {
        const cv::Mat mask = sprinkled(size, share, seed);
        REQUIRE(same_bytes(sobel_edges(mask), sobel_by_loops(mask)));
      }
}

TEST_CASE("a mask that touches the border has no edge along it") {
  CHECK(same_bytes(sobel_edges(drawn({".....", ".....", ".....", "#####", "#####", "#####"})),
                   drawn({".....", ".....", "#####", "#####", ".....", "....."})));
}

TEST_CASE("sides are padded from the bottom up to the highest pixel of the leftmost and rightmost column") {
  const cv::Mat mask = drawn({
      "......",
      "...#..",
      ".#..#.",
      ".#..#.",
      ".....#",
      "......",
  });
  CHECK(same_bytes(padded(mask), drawn({
                                     "........",
                                     "....#...",
                                     "#.#..#..",
                                     "#.#..#..",
                                     "#.....##",
                                     "#......#",
                                     "########",
                                 })));
  CHECK(same_bytes(unpadded(padded(mask)), mask));
}

TEST_CASE("a mask without pixels gets no sides, only the bottom row, and that is no part of the image") {
  for (const cv::Size size : small_sizes()) {
    const cv::Mat none = cv::Mat::zeros(size, CV_8UC1);
    const cv::Mat out = padded(none);
    REQUIRE(out.size() == size + cv::Size(2, 1));
    REQUIRE(cv::countNonZero(out) == size.width + 2);
    REQUIRE(cv::countNonZero(unpadded(contours_filled(out))) == 0);
  }
}

TEST_CASE("padding closes a contour that runs into the bottom, into a side or into both sides") {
  const auto after_padding = [](const cv::Mat& mask) { return unpadded(contours_filled(padded(mask))); };
  CHECK(same_bytes(after_padding(drawn({"......", "..##..", ".#..#.", ".#..#."})),
                   drawn({"......", "..##..", ".####.", ".####."})));
  CHECK(same_bytes(after_padding(drawn({"......", "##....", "..#...", "##....", "......"})),
                   drawn({"......", "##....", "###...", "##....", "......"})));
  CHECK(same_bytes(after_padding(drawn({"......", "......", "######", "......"})),
                   drawn({"......", "......", "######", "######"})));
}

TEST_CASE("parts are removed by their number of pixels") {
  for (const cv::Size size : small_sizes())
    for (const double share : {0.1, 0.4, 1.0}) {
      const cv::Mat mask = sprinkled(size, share, 21);
      cv::Mat part_sizes = cv::Mat::zeros(size, CV_32SC1);
      for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x)
          if (mask.at<uchar>(y, x) != 0) part_sizes.at<int>(y, x) = size_of_part(mask, {x, y});
      for (const double min_percent : {0.0, 0.5, 3.0, 30.0, 100.0}) {
        const cv::Mat expected = by_pixels(size, [&](int x, int y) {
          return mask.at<uchar>(y, x) != 0 && part_sizes.at<int>(y, x) >= min_percent / 100 * size.area();
        });
        REQUIRE(same_bytes(without_small(mask, min_percent), expected));
      }
    }
}

TEST_CASE("a part of half a percent of the image is kept, one smaller by a pixel is removed") {
  cv::Mat mask = cv::Mat::zeros(20, 60, CV_8UC1);  // 1200 pixels: half a percent are 6
  mask(cv::Rect(0, 0, 3, 2)).setTo(255);
  mask(cv::Rect(10, 0, 5, 1)).setTo(255);
  cv::Mat expected = cv::Mat::zeros(20, 60, CV_8UC1);
  expected(cv::Rect(0, 0, 3, 2)).setTo(255);
  CHECK(same_bytes(without_small(mask, 0.5), expected));
}

TEST_CASE("sizes are the paper's on its image, in proportion on others, as set where they are set") {
  CHECK(dilation_px({}, {1280, 960}) == 5);
  CHECK(closing_px({}, {1280, 960}) == 9);
  CHECK(dilation_px({}, {3840, 2880}) == 15);
  CHECK(closing_px({}, {3840, 2880}) == 27);
  CHECK(dilation_px({}, {1, 1}) == 3);
  CHECK(closing_px({}, {64, 48}) == 3);
  CHECK(dilation_px({.dilation_px = 1}, {1280, 960}) == 1);
  CHECK(closing_px({.closing_px = 1000}, {1, 1}) == 1000);
}

}  // namespace sigs::test
