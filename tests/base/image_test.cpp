// SPDX-License-Identifier: MIT
#include "base/image_codecs.h"

#include <doctest/doctest.h>

#include <filesystem>
#include <opencv2/imgcodecs.hpp>
#include <string>

#include "base/image.h"
#include "support/test_data.h"

using namespace sigs;
using namespace sigs::test;

TEST_CASE("images are allowed up to a side and a number of pixels") {
  CHECK(check_image_size({16384, 8192}).has_value());
  CHECK(check_image_size({1, 16384}).has_value());
  CHECK_FALSE(check_image_size({16385, 1}).has_value());
  CHECK_FALSE(check_image_size({16384, 8193}).has_value());
  CHECK_FALSE(check_image_size({2'000'000'000, 2'000'000'000}).has_value());
}

TEST_CASE("an image file is read as OpenCV reads it, and refused where its header does not say how large it is") {
  const TemporaryFolder folder;
  const cv::Mat image(6, 8, CV_16UC3, cv::Scalar(1000, 20000, 65535));
  for (const char* const name : {"a.png", "a.tiff", "a.ppm"}) {
    REQUIRE(cv::imwrite((folder / name).string(), image));
    const Result<cv::Mat> read = read_image_file(folder / name, cv::IMREAD_UNCHANGED);
    REQUIRE_MESSAGE(read, read.error().text());
    CHECK(cv::norm(*read, image, cv::NORM_INF) == 0);
  }
  REQUIRE(cv::imwrite((folder / "a.sr").string(), cv::Mat(6, 8, CV_8UC3, cv::Scalar::all(9))));  // Sun raster
  const Result<cv::Mat> other = read_image_file(folder / "a.sr", cv::IMREAD_UNCHANGED);
  REQUIRE_FALSE(other);
  CHECK(other.error().kind == ErrorKind::bad_data);
  write_file(folder / "large.pgm", "P5\n100000 100000\n255\n");
  const Result<cv::Mat> large = read_image_file(folder / "large.pgm", cv::IMREAD_UNCHANGED);
  REQUIRE_FALSE(large);
  CHECK(large.error().what.starts_with("is 100000x100000"));
  const Result<cv::Mat> missing = read_image_file(folder / "none.png", cv::IMREAD_UNCHANGED);
  REQUIRE_FALSE(missing);
  CHECK(missing.error().kind == ErrorKind::cannot_read);
}

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
