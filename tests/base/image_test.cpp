// SPDX-License-Identifier: MIT

#include <doctest/doctest.h>

#include "base/image.h"

using namespace sigs;

namespace {
const cv::Rect kImage(0, 0, 100, 80);
}

TEST_CASE("a box of one pixel touches that pixel alone") {
  CHECK(pixels_touched({9.6, 19.6, 0.8, 0.8}, 0, kImage) == cv::Rect(10, 20, 1, 1));
}

TEST_CASE("an edge slightly beyond a pixel's border touches the next pixel") {
  CHECK(pixels_touched({9.6, 19.6, 0.95, 0.8}, 0, kImage) == cv::Rect(10, 20, 2, 1));
  CHECK(pixels_touched({9.4, 19.6, 0.8, 0.8}, 0, kImage) == cv::Rect(9, 20, 2, 1));
}

TEST_CASE("a margin grows the rectangle and the bounds cut it") {
  CHECK(pixels_touched({9.6, 19.6, 0.8, 0.8}, 3, kImage) == cv::Rect(7, 17, 7, 7));
  CHECK(pixels_touched({-5, -5, 6, 6}, 0, kImage) == cv::Rect(0, 0, 2, 2));
}

TEST_CASE("boxes beside the image and boxes 1e9 px away touch nothing or everything") {
  CHECK(pixels_touched({200, 10, 5, 5}, 0, kImage).empty());
  CHECK(pixels_touched({-1e12, 10, 5, 5}, 0, kImage).empty());
  CHECK(pixels_touched({-1e9, -1e9, 2e9, 2e9}, 0, kImage) == kImage);
}

TEST_CASE("a box without extent still touches the pixel it lies in") {
  CHECK(pixels_touched({10.2, 20.3, 0, 0}, 0, kImage) == cv::Rect(10, 20, 1, 1));
}
