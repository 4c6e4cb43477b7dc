// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "occlusion/mean_frame.h"
#include "occlusion/stable_motion.h"

namespace {

using namespace sigs;

cv::Mat random_luma(cv::Size size, int seed) {
  cv::RNG random(static_cast<std::uint64_t>(seed) + 1);
  cv::Mat luma(size, CV_8UC1);
  random.fill(luma, cv::RNG::UNIFORM, 0, 256);
  return luma;
}

double mean_of_square(const cv::Mat& luma, int scale, int box, cv::Point at) {
  double sum = 0;
  for (int y = 0; y < box; ++y)
    for (int x = 0; x < box; ++x) sum += luma.at<std::uint8_t>(at.y * scale + y, at.x * scale + x);
  return sum / (box * box);
}

// Binomial weights 1 2 1, the image mirrored about its outermost pixels' middles.
double blurred_at(const cv::Mat& image, int x, int y) {
  const auto mirrored = [](int i, int count) { return i < 0 ? -i : i >= count ? 2 * count - 2 - i : i; };
  double sum = 0;
  for (int dy = -1; dy <= 1; ++dy)
    for (int dx = -1; dx <= 1; ++dx)
      sum += (2 - std::abs(dx)) * (2 - std::abs(dy)) *
             static_cast<double>(image.at<float>(mirrored(y + dy, image.rows), mirrored(x + dx, image.cols)));
  return sum / 16;
}

cv::Point2d slope_at(const cv::Mat& image, int x, int y) {
  const auto at = [&](int column, int row) {
    return blurred_at(image, std::clamp(column, 0, image.cols - 1), std::clamp(row, 0, image.rows - 1));
  };
  return {(at(x + 1, y) - at(x - 1, y)) / 2, (at(x, y + 1) - at(x, y - 1)) / 2};
}

MeanFrame random_image(int seed, int frames) {
  cv::Mat luma;
  random_luma({9, 7}, seed).convertTo(luma, CV_32F);
  return {luma, frames};
}

}  // namespace

TEST_CASE("a mean image is the mean of its frames over squares of pixels, whatever the size") {
  for (const cv::Size size : {cv::Size(7, 5), cv::Size(1281, 31), cv::Size(3850, 29)}) {
    FrameAverager averager(size);
    std::vector<cv::Mat> frames;
    for (int n = 0; n < 300; ++n) {
      if (averager.is_full()) averager.clear();
      if (averager.waiting() == 0) frames.clear();
      frames.push_back(random_luma(size, n));
      averager.add(frames.back());
    }
    REQUIRE(averager.waiting() == static_cast<int>(frames.size()));
    const MeanFrame image = averager.image();
    CHECK(image.frames == averager.waiting());
    CHECK(image.luma.cols <= 640);
    CHECK(image.luma.cols == size.width / averager.scale());
    const int box = std::min(4, averager.scale());  // of larger squares a part is used
    for (const cv::Point at : {cv::Point(0, 0), cv::Point(image.luma.cols - 1, image.luma.rows - 1)}) {
      double sum = 0;
      for (const cv::Mat& frame : frames) sum += mean_of_square(frame, averager.scale(), box, at);
      CHECK(image.luma.at<float>(at) == doctest::Approx(sum / static_cast<double>(frames.size())).epsilon(1e-5));
    }
  }
}

TEST_CASE("eight white frames of the largest square do not overflow") {
  const cv::Mat white(40, 6400, CV_8UC1, cv::Scalar(255));
  FrameAverager averager(white.size());
  for (int n = 0; n < 200; ++n) {
    if (averager.is_full()) {
      CHECK(cv::norm(averager.image().luma - 255, cv::NORM_INF) < 1e-3);
      averager.clear();
    }
    averager.add(white);
  }
}

TEST_CASE("the gradient's moments are those of a plain double loop over the images") {
  std::vector<MeanFrame> images;
  GradientSums sums({9, 7});
  for (int n = 0; n < 12; ++n) {
    images.push_back(random_image(n, 1 + n % 3));
    sums.add(images.back());
  }
  const GradientMoments moments = sums.moments();
  CHECK(moments.frames_per_mean == doctest::Approx((1 + 2 + 3) * 4 / 12.0));
  for (int y = 0; y < 7; ++y)
    for (int x = 0; x < 9; ++x) {
      cv::Point2d mean;
      double square = 0;
      int frames = 0;
      for (const MeanFrame& image : images) {
        const cv::Point2d slope = slope_at(image.luma, x, y);
        mean += slope * image.frames;
        square += slope.dot(slope) * image.frames;
        frames += image.frames;
      }
      CHECK(std::abs(moments.mean_x.at<float>(y, x) - mean.x / frames) < 1e-3);  // slopes up to 128, 7 digits
      CHECK(std::abs(moments.mean_y.at<float>(y, x) - mean.y / frames) < 1e-3);
      CHECK(moments.mean_square.at<float>(y, x) == doctest::Approx(square / frames).epsilon(1e-4));
    }
}

TEST_CASE("images of any size are blurred as OpenCV does") {
  for (const cv::Size size : {cv::Size(1, 1), cv::Size(2, 1), cv::Size(1, 3), cv::Size(2, 2), cv::Size(37, 11)}) {
    cv::Mat luma, blurred;
    random_luma(size, 3).convertTo(luma, CV_32F, 1.0 / 3);  // means of three frames have fractions
    cv::GaussianBlur(luma, blurred, {3, 3}, 0);
    GradientSums sums(size);
    sums.add({luma, 1});
    const GradientMoments moments = sums.moments();
    for (int y = 0; y < size.height; ++y)
      for (int x = 0; x < size.width; ++x) {
        const auto at = [&](int column, int row) {
          return blurred.at<float>(std::clamp(row, 0, size.height - 1), std::clamp(column, 0, size.width - 1));
        };
        // Codes up to 85 have 24 bits each; OpenCV may add them in another order.
        CHECK(std::abs(moments.mean_x.at<float>(y, x) - (at(x + 1, y) - at(x - 1, y)) / 2) < 1e-4F);
        CHECK(std::abs(moments.mean_y.at<float>(y, x) - (at(x, y + 1) - at(x, y - 1)) / 2) < 1e-4F);
      }
  }
}

TEST_CASE("a clone of the sums is independent") {
  GradientSums sums({9, 7});
  sums.add(random_image(1, 1));
  const cv::Mat before = sums.moments().mean_square;
  GradientSums other = sums.clone();
  other.add(random_image(2, 5));
  CHECK(cv::norm(before, sums.moments().mean_square, cv::NORM_INF) == 0);
}

TEST_CASE("however long the footage, its segments are few, of one length, and hold every frame once") {
  FootageSegments segments;
  int frames = 0;
  double sum = 0;
  for (int n = 0; n < 5000; ++n) {
    const int length = n < 16 ? 1 : 8;
    segments.add({cv::Mat(2, 2, CV_32FC1, cv::Scalar(n % 251)), length});
    frames += length;
    sum += length * (n % 251);
    CHECK(segments.segments().size() <= 48);
  }
  int held = 0;
  double held_sum = 0;
  for (const MeanFrame& segment : segments.segments()) {
    held += segment.frames;
    held_sum += segment.frames * static_cast<double>(segment.luma.at<float>(0, 0));
  }
  CHECK(held == frames);
  CHECK(held_sum == doctest::Approx(sum).epsilon(1e-4));
  const auto [shortest, longest] =
      std::minmax_element(segments.segments().begin(), segments.segments().end() - 1,
                          [](const MeanFrame& a, const MeanFrame& b) { return a.frames < b.frames; });
  CHECK(longest->frames <= 2 * shortest->frames);
}
