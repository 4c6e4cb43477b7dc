// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <vector>

#include "occlusion/film_segments.h"
#include "occlusion/gradient_sums.h"
#include "occlusion/mean_picture.h"

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

// Binomial weights 1 2 1, the picture mirrored about its outermost pixels' middles.
double blurred_at(const cv::Mat& picture, int x, int y) {
  const auto mirrored = [](int i, int count) { return i < 0 ? -i : i >= count ? 2 * count - 2 - i : i; };
  double sum = 0;
  for (int dy = -1; dy <= 1; ++dy)
    for (int dx = -1; dx <= 1; ++dx)
      sum += (2 - std::abs(dx)) * (2 - std::abs(dy)) *
             static_cast<double>(picture.at<float>(mirrored(y + dy, picture.rows), mirrored(x + dx, picture.cols)));
  return sum / 16;
}

cv::Point2d slope_at(const cv::Mat& picture, int x, int y) {
  const auto at = [&](int column, int row) {
    return blurred_at(picture, std::clamp(column, 0, picture.cols - 1), std::clamp(row, 0, picture.rows - 1));
  };
  return {(at(x + 1, y) - at(x - 1, y)) / 2, (at(x, y + 1) - at(x, y - 1)) / 2};
}

MeanPicture random_picture(int seed, int frames) {
  cv::Mat luma;
  random_luma({9, 7}, seed).convertTo(luma, CV_32F);
  return {luma, frames};
}

}  // namespace

TEST_CASE("a mean picture is the mean of its frames over squares of pixels, whatever the size") {
  for (const cv::Size size : {cv::Size(7, 5), cv::Size(1281, 31), cv::Size(3850, 29)}) {
    FrameGatherer gatherer(size);
    std::vector<cv::Mat> frames;
    for (int n = 0; n < 300; ++n) {
      if (gatherer.is_full()) gatherer.clear();
      if (gatherer.waiting() == 0) frames.clear();
      frames.push_back(random_luma(size, n));
      gatherer.add(frames.back());
    }
    REQUIRE(gatherer.waiting() == static_cast<int>(frames.size()));
    const MeanPicture picture = gatherer.picture();
    CHECK(picture.frames == gatherer.waiting());
    CHECK(picture.luma.cols <= 640);
    CHECK(picture.luma.cols == size.width / gatherer.scale());
    const int box = std::min(4, gatherer.scale());  // of larger squares a part is looked at
    for (const cv::Point at : {cv::Point(0, 0), cv::Point(picture.luma.cols - 1, picture.luma.rows - 1)}) {
      double sum = 0;
      for (const cv::Mat& frame : frames) sum += mean_of_square(frame, gatherer.scale(), box, at);
      CHECK(picture.luma.at<float>(at) == doctest::Approx(sum / static_cast<double>(frames.size())).epsilon(1e-5));
    }
  }
}

TEST_CASE("eight white frames of the largest square do not overflow") {
  const cv::Mat white(40, 6400, CV_8UC1, cv::Scalar(255));
  FrameGatherer gatherer(white.size());
  for (int n = 0; n < 200; ++n) {
    if (gatherer.is_full()) {
      CHECK(cv::norm(gatherer.picture().luma - 255, cv::NORM_INF) < 1e-3);
      gatherer.clear();
    }
    gatherer.add(white);
  }
}

TEST_CASE("the gradient's moments are those of a plain double loop over the pictures") {
  std::vector<MeanPicture> pictures;
  GradientSums sums({9, 7});
  for (int n = 0; n < 12; ++n) {
    pictures.push_back(random_picture(n, 1 + n % 3));
    sums.add(pictures.back());
  }
  const GradientMoments moments = sums.moments();
  CHECK(moments.picture_frames == doctest::Approx((1 + 2 + 3) * 4 / 12.0));
  for (int y = 0; y < 7; ++y)
    for (int x = 0; x < 9; ++x) {
      cv::Point2d mean;
      double square = 0;
      int frames = 0;
      for (const MeanPicture& picture : pictures) {
        const cv::Point2d slope = slope_at(picture.luma, x, y);
        mean += slope * picture.frames;
        square += slope.dot(slope) * picture.frames;
        frames += picture.frames;
      }
      CHECK(std::abs(moments.mean_x.at<float>(y, x) - mean.x / frames) < 1e-3);  // slopes up to 128, 7 digits
      CHECK(std::abs(moments.mean_y.at<float>(y, x) - mean.y / frames) < 1e-3);
      CHECK(moments.mean_square.at<float>(y, x) == doctest::Approx(square / frames).epsilon(1e-4));
    }
}

TEST_CASE("a clone of the sums goes its own way") {
  GradientSums sums({9, 7});
  sums.add(random_picture(1, 1));
  const cv::Mat before = sums.moments().mean_square;
  GradientSums other = sums.clone();
  other.add(random_picture(2, 5));
  CHECK(cv::norm(before, sums.moments().mean_square, cv::NORM_INF) == 0);
}

TEST_CASE("however long the film, its segments are few, of one length, and hold every frame once") {
  FilmSegments segments;
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
  for (const MeanPicture& segment : segments.segments()) {
    held += segment.frames;
    held_sum += segment.frames * static_cast<double>(segment.luma.at<float>(0, 0));
  }
  CHECK(held == frames);
  CHECK(held_sum == doctest::Approx(sum).epsilon(1e-4));
  const auto [shortest, longest] =
      std::minmax_element(segments.segments().begin(), segments.segments().end() - 1,
                          [](const MeanPicture& a, const MeanPicture& b) { return a.frames < b.frames; });
  CHECK(longest->frames <= 2 * shortest->frames);
}
