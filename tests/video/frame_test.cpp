// SPDX-License-Identifier: MIT
#include "video/frame.h"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <vector>

#include "video/clips.h"
#include "video/frame_source.h"

using namespace sigs;
using namespace sigs::test;

namespace {

cv::Vec3f rgb_of(const CodeToRgb& map, cv::Vec3f code) {
  return map.to_rgb * (code - map.offset);
}

constexpr std::array kRanges{ColorRange::limited, ColorRange::full};
constexpr std::array kMatrices{ColorMatrix::bt601, ColorMatrix::bt709, ColorMatrix::bt2020};

// Codes are rounded to whole numbers in published tables; half a code is 0.5 / 219 of the scale, times at most 2.
constexpr double kFloatTolerance = 1e-6;

}  // namespace

TEST_CASE("white and black have their codes in every range and matrix") {
  for (const ColorMatrix matrix : kMatrices) {
    const CodeToRgb limited = code_to_rgb(PixelLayout::yuv420, color_info(ColorRange::limited, matrix));
    const CodeToRgb full = code_to_rgb(PixelLayout::yuv420, color_info(ColorRange::full, matrix));
    for (int i = 0; i < 3; ++i) {
      CHECK(rgb_of(limited, {235, 128, 128})[i] == doctest::Approx(1).epsilon(kFloatTolerance));
      CHECK(rgb_of(limited, {16, 128, 128})[i] == doctest::Approx(0));
      CHECK(rgb_of(full, {255, 128, 128})[i] == doctest::Approx(1).epsilon(kFloatTolerance));
      CHECK(rgb_of(full, {0, 128, 128})[i] == doctest::Approx(0));
    }
  }
}

TEST_CASE("primaries have the codes of the standards' colour bars") {
  struct Bar {
    ColorMatrix matrix;
    cv::Vec3f rgb;
    cv::Vec3f code;  // 100 % bars, limited range, as published for 8 bits
  };
  const std::vector<Bar> bars{
      {ColorMatrix::bt601, {1, 0, 0}, {81, 90, 240}},  {ColorMatrix::bt601, {0, 1, 0}, {145, 54, 34}},
      {ColorMatrix::bt601, {0, 0, 1}, {41, 240, 110}}, {ColorMatrix::bt709, {1, 0, 0}, {63, 102, 240}},
      {ColorMatrix::bt709, {0, 1, 0}, {173, 42, 26}},  {ColorMatrix::bt709, {0, 0, 1}, {32, 240, 118}},
      {ColorMatrix::bt709, {1, 1, 0}, {219, 16, 138}},
  };
  for (const Bar& bar : bars) {
    const CodeToRgb map = code_to_rgb(PixelLayout::yuv444, color_info(ColorRange::limited, bar.matrix));
    const cv::Vec3f code = map.from_rgb * bar.rgb + map.offset;
    for (int i = 0; i < 3; ++i) CHECK(std::abs(code[i] - bar.code[i]) <= 0.5 + 1e-4);  // the tables are rounded
  }
}

TEST_CASE("full-range red of BT601 is JPEG's red") {
  // ITU-T T.871 (JFIF): Y = 0.299 R, Cb = 128 - 0.168736 R, Cr = 128 + 0.5 R.
  const CodeToRgb map = code_to_rgb(PixelLayout::yuv420, color_info(ColorRange::full, ColorMatrix::bt601));
  const cv::Vec3f code = map.from_rgb * cv::Vec3f(1, 0, 0) + map.offset;
  CHECK(code[0] == doctest::Approx(0.299 * 255).epsilon(1e-6));
  CHECK(code[1] == doctest::Approx(128 - 0.168736 * 255).epsilon(1e-5));
  CHECK(code[2] == doctest::Approx(128 + 0.5 * 255).epsilon(1e-6));
}

TEST_CASE("conversion to RGB and back is the identity for every layout with three planes") {
  for (const PixelLayout layout : {PixelLayout::yuv420, PixelLayout::yuv422, PixelLayout::yuv444, PixelLayout::rgb})
    for (const ColorRange range : kRanges)
      for (const ColorMatrix matrix : kMatrices) {
        const CodeToRgb map = code_to_rgb(layout, color_info(range, matrix));
        CHECK(cv::norm(map.to_rgb * map.from_rgb - cv::Matx33f::eye()) < 1e-5);  // nine sums of floats near 1
      }
}

TEST_CASE("luma alone gives gray and takes the weighted mean") {
  const CodeToRgb map = code_to_rgb(PixelLayout::gray, color_info(ColorRange::limited, ColorMatrix::bt709));
  const cv::Vec3f rgb = rgb_of(map, {126, 7, 9});
  for (int i = 0; i < 3; ++i) CHECK(rgb[i] == doctest::Approx(110.0 / 219).epsilon(kFloatTolerance));
  const cv::Vec3f code = map.from_rgb * cv::Vec3f(1, 0, 0) + map.offset;
  CHECK(code[0] == doctest::Approx(16 + 219 * 0.2126).epsilon(kFloatTolerance));
}

TEST_CASE("a clone shares no samples") {
  const Frame frame = test_frame(PixelLayout::yuv420, {9, 7}, 0);
  Frame copy = cloned(frame);
  CHECK(samples_of(copy) == samples_of(frame));
  copy.planes[0].at<uchar>(0, 0) = static_cast<uchar>(copy.planes[0].at<uchar>(0, 0) ^ 1);
  CHECK(samples_of(copy) != samples_of(frame));
}

TEST_CASE("the chroma step tells the subsampling") {
  CHECK(chroma_step(PixelLayout::yuv420) == cv::Size(2, 2));
  CHECK(chroma_step(PixelLayout::yuv422) == cv::Size(2, 1));
  for (const PixelLayout layout : {PixelLayout::gray, PixelLayout::yuv444, PixelLayout::rgb})
    CHECK(chroma_step(layout) == cv::Size(1, 1));
}

TEST_CASE("luma is plane 0 itself where the footage has luma") {
  for (const PixelLayout layout : {PixelLayout::gray, PixelLayout::yuv420, PixelLayout::yuv422, PixelLayout::yuv444}) {
    const Frame frame = blank_frame(layout, {5, 3}, {});
    CHECK(luma_of(frame).data == frame.planes[0].data);
  }
}

TEST_CASE("luma of RGB is the weighted sum of BT.709 and of grey it is grey") {
  Frame frame = blank_frame(PixelLayout::rgb, {256, 4}, {});
  cv::RNG chance(3);
  for (cv::Mat& plane : frame.planes) chance.fill(plane, cv::RNG::UNIFORM, 0, 256);
  for (cv::Mat& plane : frame.planes)
    for (int x = 0; x < 256; ++x) plane.at<uchar>(0, x) = static_cast<uchar>(x);
  const cv::Mat luma = luma_of(frame);
  for (int x = 0; x < 256; ++x) CHECK(luma.at<uchar>(0, x) == x);
  for (int y = 1; y < 4; ++y)
    for (int x = 0; x < 256; ++x) {
      const double exact = 0.2126 * frame.planes[0].at<uchar>(y, x) + 0.7152 * frame.planes[1].at<uchar>(y, x) +
                           0.0722 * frame.planes[2].at<uchar>(y, x);
      // Weights are off by at most 0.0021 (blue: 19/256) on 255 codes, and rounding by half a code.
      CHECK(std::abs(luma.at<uchar>(y, x) - exact) <= 1.1);
    }
}
