// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "video/chroma.h"
#include "video/clips.h"
#include "video/frame.h"
#include "video/reduced_bgr.h"

using namespace sigs;
using namespace sigs::test;

namespace {

constexpr std::array kSites{ChromaSite::left, ChromaSite::center, ChromaSite::top_left};

cv::Mat smooth_bgr(cv::Size size) {
  cv::Mat bgr(size, CV_8UC3);
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x)
      bgr.at<cv::Vec3b>(y, x) = {static_cast<uchar>(40 + 2 * x), static_cast<uchar>(60 + 3 * y),
                                 static_cast<uchar>(180 - x - y)};
  return bgr;
}

double largest_difference(const cv::Mat& a, const cv::Mat& b) {
  return cv::norm(a, b, cv::NORM_INF);
}

}  // namespace

TEST_CASE("one colour everywhere stays that colour whatever the layout size and siting") {
  const cv::Vec3b colour(60, 130, 200);
  for (const PixelLayout layout : kLayouts)
    for (const ChromaSite site : kSites)
      for (const cv::Size size : {cv::Size(1, 1), cv::Size(2, 2), cv::Size(7, 5), cv::Size(16, 9)}) {
        const ColorInfo color = color_info(ColorRange::full, ColorMatrix::bt709, site);
        const cv::Mat bgr(size, CV_8UC3, cv::Scalar(colour));
        const cv::Mat back = bgr_of(frame_of_bgr(bgr, layout, color));
        REQUIRE(back.size() == size);
        const double gray = 0.2126 * 200 + 0.7152 * 130 + 0.0722 * 60;
        const cv::Scalar expected = layout == PixelLayout::gray ? cv::Scalar::all(gray) : cv::Scalar(colour);
        // Half a code of rounding in luma and in chroma, the latter times 1.8556 for blue.
        CHECK(largest_difference(back, cv::Mat(size, CV_8UC3, expected)) <= 1.5);
      }
}

TEST_CASE("without subsampling an image comes back within rounding") {
  const cv::Mat bgr = smooth_bgr({50, 40});
  for (const ColorMatrix matrix : {ColorMatrix::bt601, ColorMatrix::bt709, ColorMatrix::bt2020}) {
    const cv::Mat full = bgr_of(frame_of_bgr(bgr, PixelLayout::yuv444, color_info(ColorRange::full, matrix)));
    CHECK(largest_difference(full, bgr) <= 2);  // 0.5 luma + 0.5 * 1.88 chroma + 0.5 at the end
    const cv::Mat limited = bgr_of(frame_of_bgr(bgr, PixelLayout::yuv444, color_info(ColorRange::limited, matrix)));
    CHECK(largest_difference(limited, bgr) <= 2);  // the same, times 255 / 219, still below 2.5
  }
  CHECK(largest_difference(bgr_of(frame_of_bgr(bgr, PixelLayout::rgb, {})), bgr) == 0);
}

TEST_CASE("limited BT601 agrees with OpenCV") {
  // OpenCV's I420 is BT.601 limited range with chroma repeated, not interpolated: equal where chroma does not change.
  cv::Mat bgr = cv::Mat(20, 30, CV_8UC3, cv::Scalar(50, 120, 190));
  bgr(cv::Rect(0, 0, 30, 8)).setTo(cv::Scalar(70, 140, 210));  // the same chroma, brighter
  const Frame frame = frame_of_bgr(bgr, PixelLayout::yuv420, color_info(ColorRange::limited, ColorMatrix::bt601));
  cv::Mat theirs;
  cv::cvtColor(bgr, theirs, cv::COLOR_BGR2YUV_I420);
  CHECK(largest_difference(frame.planes[0], theirs.rowRange(0, 20)) <= 1);  // its coefficients have 20 bits
  cv::Mat joined(30, 30, CV_8UC1);
  std::copy_n(frame.planes[0].data, 600, joined.data);
  std::copy_n(frame.planes[1].data, 150, joined.data + 600);
  std::copy_n(frame.planes[2].data, 150, joined.data + 750);
  cv::Mat their_bgr;
  cv::cvtColor(joined, their_bgr, cv::COLOR_YUV2BGR_I420);
  CHECK(largest_difference(bgr_of(frame), their_bgr) <= 1);
}

TEST_CASE("full BT601 agrees with OpenCV") {
  const cv::Mat bgr = smooth_bgr({33, 21});
  cv::Mat ycrcb;
  cv::cvtColor(bgr, ycrcb, cv::COLOR_BGR2YCrCb);  // Y, Cr, Cb of JPEG
  const Frame frame = frame_of_bgr(bgr, PixelLayout::yuv444, color_info(ColorRange::full, ColorMatrix::bt601));
  for (const auto& [plane, channel] : {std::pair{0, 0}, std::pair{1, 2}, std::pair{2, 1}}) {
    cv::Mat theirs;
    cv::extractChannel(ycrcb, theirs, channel);
    CHECK(largest_difference(frame.planes[static_cast<size_t>(plane)], theirs) <= 1);  // its coefficients are rounded
  }
}

TEST_CASE("chroma is read and written at the positions of its site") {
  // Cb is a ramp over x and y. A ramp is its own linear interpolation, and its own mean about the sample's position, so
  // a chroma sample must have the ramp's value at its position, and every luma pixel inside must read the ramp's value.
  const cv::Size size(40, 24);
  const auto ramp = [](double x, double y) { return 100 + 1.0 * x + 2.0 * y; };
  for (const ChromaSite site : kSites) {
    const double dx = site == ChromaSite::center ? 0.5 : 0;
    const double dy = site == ChromaSite::top_left ? 0 : 0.5;
    const ColorInfo color = color_info(ColorRange::full, ColorMatrix::bt601, site);
    Frame frame;
    frame.layout = PixelLayout::yuv420;
    frame.color = color;
    frame.planes[0] = cv::Mat(size, CV_8UC1, cv::Scalar(90));
    frame.planes[2] = cv::Mat(12, 20, CV_8UC1, cv::Scalar(128));
    frame.planes[1] = cv::Mat(12, 20, CV_8UC1);
    for (int y = 0; y < 12; ++y)
      for (int x = 0; x < 20; ++x)
        frame.planes[1].at<uchar>(y, x) = static_cast<uchar>(ramp(2 * x + dx, 2 * y + dy) + 0.25);
    const cv::Mat bgr = bgr_of(frame);
    for (int y = 2; y < 22; ++y)
      for (int x = 2; x < 38; ++x) {
        const double blue = 90 + 1.772 * (ramp(x, y) - 128);
        if (blue < 1 || blue > 254) continue;
        // The ramp is stored with an error of at most 0.5, times 1.772, and the result is rounded.
        CHECK(std::abs(bgr.at<cv::Vec3b>(y, x)[0] - blue) <= 0.5 * 1.772 + 0.5 + 1e-3);
      }
  }
}

TEST_CASE("shrunk chroma keeps a ramp at the positions of its site") {
  cv::Mat bgr(20, 40, CV_8UC3);
  for (int y = 0; y < 20; ++y)
    for (int x = 0; x < 40; ++x) bgr.at<cv::Vec3b>(y, x) = {static_cast<uchar>(4 * x + 2 * y + 20), 90, 90};
  for (const ChromaSite site : kSites) {
    const double dx = site == ChromaSite::center ? 0.5 : 0;
    const double dy = site == ChromaSite::top_left ? 0 : 0.5;
    const Frame frame = frame_of_bgr(bgr, PixelLayout::yuv420, color_info(ColorRange::full, ColorMatrix::bt601, site));
    REQUIRE(frame.planes[1].size() == cv::Size(20, 10));
    for (int y = 1; y < 9; ++y)
      for (int x = 1; x < 19; ++x) {
        const double blue = 4 * (2 * x + dx) + 2 * (2 * y + dy) + 20;
        const double cb = 128 + (blue - 90) * 0.5;                            // JFIF: 0.5 B - 0.168736 R - 0.331264 G
        CHECK(std::abs(frame.planes[1].at<uchar>(y, x) - cb) <= 0.5 + 1e-3);  // rounded to a code
      }
  }
}

TEST_CASE("values beyond the gamut are clipped and not wrapped") {
  Frame frame;
  frame.layout = PixelLayout::yuv444;
  frame.color = color_info(ColorRange::limited, ColorMatrix::bt709);
  frame.planes = {cv::Mat(1, 2, CV_8UC1, cv::Scalar(255)), cv::Mat(1, 2, CV_8UC1, cv::Scalar(255)),
                  cv::Mat(1, 2, CV_8UC1, cv::Scalar(255))};
  frame.planes[0].at<uchar>(0, 1) = 0;
  const cv::Mat bgr = bgr_of(frame);
  CHECK(bgr.at<cv::Vec3b>(0, 0)[0] == 255);
  CHECK(bgr.at<cv::Vec3b>(0, 0)[2] == 255);
  CHECK(bgr.at<cv::Vec3b>(0, 1)[1] == 0);
}

TEST_CASE("every byte of a converted image is that of the plain formula pixel by pixel") {
  const auto tap = [](const cv::Mat& plane, const ChromaTap& row, const ChromaTap& column) {
    const auto at = [&](int x) {
      const float first = plane.at<uchar>(row.first, x);
      return first + row.share * (static_cast<float>(plane.at<uchar>(row.second, x)) - first);
    };
    const float left = at(column.first);
    return left + column.share * (at(column.second) - left);
  };
  for (const PixelLayout layout : {PixelLayout::yuv420, PixelLayout::yuv422, PixelLayout::yuv444})
    for (const ChromaSite site : kSites)
      for (const ColorRange range : {ColorRange::limited, ColorRange::full})
        for (const cv::Size size :
             {cv::Size(1, 1), cv::Size(15, 4), cv::Size(16, 5), cv::Size(33, 7), cv::Size(98, 6)}) {
          Frame frame = test_frame(layout, size, 3, color_info(range, ColorMatrix::bt601, site));
          for (int i = 0; i < 3; ++i)  // every code value, far outside the range of images
            cv::randu(frame.planes[static_cast<size_t>(i)], 0, 256);
          const CodeToRgb map = code_to_rgb(layout, frame.color);
          const cv::Matx33f m = map.to_rgb * 255.0F;
          const cv::Size step = chroma_step(layout);
          const auto columns = chroma_taps(size.width, step.width, chroma_on_luma_column(site));
          const auto rows = chroma_taps(size.height, step.height, chroma_on_luma_row(site));
          cv::Mat expected(size, CV_8UC3);
          for (int y = 0; y < size.height; ++y)
            for (int x = 0; x < size.width; ++x) {
              const ChromaTap& row = rows[static_cast<size_t>(y)];
              const ChromaTap& column = columns[static_cast<size_t>(x)];
              const float luma = static_cast<float>(frame.planes[0].at<uchar>(y, x)) - map.offset[0];
              const float cb = tap(frame.planes[1], row, column) - map.offset[1];
              const float cr = tap(frame.planes[2], row, column) - map.offset[2];
              for (int c = 0; c < 3; ++c) {
                const float value = m(2 - c, 0) * luma + m(2 - c, 1) * cb + m(2 - c, 2) * cr;
                expected.at<cv::Vec3b>(y, x)[c] = static_cast<uchar>(std::clamp(value, 0.0F, 255.0F) + 0.5F);
              }
            }
          CHECK(largest_difference(bgr_of(frame), expected) == 0);
        }
}

namespace {

// The mean of a plane's samples that pixels of the block have, rounded as codes are.
double block_mean(const cv::Mat& plane, const cv::Size& step, const cv::Rect& block) {
  double sum = 0;
  int count = 0;
  for (int y = 0; y < plane.rows; ++y)
    for (int x = 0; x < plane.cols; ++x)
      if (!(cv::Rect({x * step.width, y * step.height}, step) & block).empty()) {
        sum += sample_at(plane, y, x);
        ++count;
      }
  return std::floor(sum / count + 0.5);
}

cv::Vec3d bgr_of_block(const Frame& frame, const cv::Rect& block) {
  cv::Vec3d code(0, 0, 0);
  for (int i = 0; i < frame.plane_count(); ++i)
    code[i] = block_mean(frame.planes[static_cast<std::size_t>(i)], i == 0 ? cv::Size(1, 1) : chroma_step(frame.layout),
                         block);
  const CodeToRgb map = code_to_rgb(frame.layout, frame.color, frame.bit_depth);
  cv::Vec3d bgr(0, 0, 0);
  for (int c = 0; c < 3; ++c)
    for (int i = 0; i < 3; ++i)
      if (frame.layout != PixelLayout::gray || i == 0)
        bgr[2 - c] += 255.0 * map.to_rgb(c, i) * (code[i] - map.offset[i]);
  for (int c = 0; c < 3; ++c) bgr[c] = std::clamp(bgr[c], 0.0, 255.0);
  return bgr;
}

}  // namespace

TEST_CASE("a smaller image has the colours of the mean codes of its blocks") {
  cv::RNG random(29);
  for (const PixelLayout layout :
       {PixelLayout::gray, PixelLayout::yuv420, PixelLayout::yuv422, PixelLayout::yuv444, PixelLayout::rgb})
    for (const int bit_depth : {8, 10, 16})
      for (const cv::Rect& part : {cv::Rect(0, 0, 37, 23), cv::Rect(12, 6, 13, 11), cv::Rect(9, 15, 1, 1)}) {
        Frame frame = blank_frame(layout, {37, 23}, {}, bit_depth);
        for (int i = 0; i < frame.plane_count(); ++i)
          random.fill(frame.planes[static_cast<std::size_t>(i)], cv::RNG::UNIFORM, 0, 1 << bit_depth);
        for (const int divisor : {2, 3, 4, 5, 6, 7, 8, 50}) {
          const cv::Mat small = reduced_bgr(frame, part, divisor);
          REQUIRE(small.size() ==
                  cv::Size((part.width + divisor - 1) / divisor, (part.height + divisor - 1) / divisor));
          double largest = 0;
          for (int j = 0; j < small.rows; ++j)
            for (int i = 0; i < small.cols; ++i) {
              const cv::Rect block = cv::Rect(part.x + i * divisor, part.y + j * divisor, divisor, divisor) & part;
              const cv::Vec3d off = cv::Vec3d(small.at<cv::Vec3b>(j, i)) - bgr_of_block(frame, block);
              largest = std::max(largest, cv::norm(off, cv::NORM_INF));
            }
          CAPTURE(bit_depth);
          CAPTURE(divisor);
          CHECK(largest <= 1.001);  // RGB of more bits is rounded to 8 by itself
        }
      }
}

TEST_CASE("a smaller image is the mean of the converted one, within three codes, where colours change gently") {
  cv::Mat bgr(181, 241, CV_8UC3);
  cv::RNG random(31);
  for (int y = 0; y < bgr.rows; ++y)
    for (int x = 0; x < bgr.cols; ++x) {
      const int grain = random.uniform(-12, 13);
      bgr.at<cv::Vec3b>(y, x) = {static_cast<uchar>(140 + grain + x / 4), static_cast<uchar>(120 + grain),
                                 static_cast<uchar>(90 + grain + y / 4)};
    }
  for (const PixelLayout layout : {PixelLayout::yuv420, PixelLayout::yuv422, PixelLayout::yuv444})
    for (const ChromaSite site : {ChromaSite::left, ChromaSite::center, ChromaSite::top_left}) {
      const Frame frame = frame_of_bgr(bgr, layout, {.chroma_site = site});
      const cv::Mat whole = bgr_of(frame);
      for (const int divisor : {2, 3, 4, 7}) {
        const cv::Mat small = reduced_bgr(frame, {{0, 0}, bgr.size()}, divisor);
        double largest = 0;
        for (int j = 0; j < small.rows; ++j)
          for (int i = 0; i < small.cols; ++i) {
            const cv::Rect block = cv::Rect(i * divisor, j * divisor, divisor, divisor) & cv::Rect({0, 0}, bgr.size());
            const cv::Scalar mean = cv::mean(whole(block));
            for (int c = 0; c < 3; ++c) largest = std::max(largest, std::abs(small.at<cv::Vec3b>(j, i)[c] - mean[c]));
          }
        // Half a code of luma and of chroma each, times 1.164 and 2.112 for blue, half at the end, and what chroma
        // differs from block to block where they share a sample.
        CHECK(largest <= 3);
      }
    }
}
