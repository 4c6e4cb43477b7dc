// SPDX-License-Identifier: MIT
#include "appearance/noise.h"

#include <doctest/doctest.h>

#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "appearance/noise_blocks.h"
#include "support/test_data.h"
#include "video/frame_source.h"

using namespace sigs;
using namespace sigs::test;

namespace {

struct Added {
  double sd_dark = 2, sd_bright = 2;  // variance linear in brightness between them
  double sd_chroma = 0;
  double correlation_length_px = 0;
  double temporal_correlation = 0;
};

// Normal noise of variance 1, blurred by OpenCV; each frame keeps part of the one before (autoregressive).
class NoiseField {
 public:
  NoiseField(cv::Size size, const Added& added, int seed) : added_(added), random_(static_cast<std::uint64_t>(seed)) {
    last_ = fresh(size);
  }
  cv::Mat next() {
    const double kept = added_.temporal_correlation;
    last_ = kept * last_ + std::sqrt(1 - kept * kept) * fresh(last_.size());
    return last_;
  }

 private:
  cv::Mat fresh(cv::Size size) {
    cv::Mat noise(size, CV_32FC1);
    random_.fill(noise, cv::RNG::NORMAL, 0, 1);
    if (added_.correlation_length_px > 0) {
      cv::GaussianBlur(noise, noise, {}, added_.correlation_length_px);
      cv::Scalar mean, deviation;
      cv::meanStdDev(noise, mean, deviation);
      noise /= deviation[0];
    }
    return noise;
  }
  Added added_;
  cv::RNG random_;
  cv::Mat last_;
};

// Adds noise to the frame; 16 black, 235 white.
void add_noise(Frame& frame, const Added& added, NoiseField& luma, NoiseField& chroma) {
  const cv::Mat noise = luma.next();
  cv::Mat& plane = frame.planes[0];
  for (int y = 0; y < plane.rows; ++y) {
    for (int x = 0; x < plane.cols; ++x) {
      const double b = (plane.at<uchar>(y, x) - 16) / 219.0;
      const double variance = added.sd_dark * added.sd_dark * (1 - b) + added.sd_bright * added.sd_bright * b;
      plane.at<uchar>(y, x) =
          cv::saturate_cast<uchar>(plane.at<uchar>(y, x) + std::sqrt(std::max(variance, 0.0)) * noise.at<float>(y, x));
    }
  }
  for (const int c : {1, 2}) {
    cv::Mat sum;
    frame.planes[c].convertTo(sum, CV_32F);
    sum += added.sd_chroma * chroma.next();
    sum.convertTo(frame.planes[c], CV_8U);
  }
}

// Half as large each way and blurred, so that nothing is left of its own noise and its finest texture: 640x480.
Frame halved(const Frame& frame) {
  Frame half = frame;
  for (cv::Mat& plane : half.planes) {
    cv::resize(plane, plane, {}, 0.5, 0.5, cv::INTER_AREA);
    cv::GaussianBlur(plane, plane, {}, 1.2);
  }
  return half;
}

NoiseFound found_in_sample(const Added& added) {
  Result<FrameSource> footage = FrameSource::open(source_dir() / "assets/footage/sample.mp4");
  REQUIRE(footage);
  Noise noise;
  NoiseField luma({640, 480}, added, 7), chroma({320, 240}, {.temporal_correlation = added.temporal_correlation}, 8);
  for (int n = 0; n < 12; n += 4) {
    Frame first = halved(footage->read(n).value());
    Frame second = halved(footage->read(n + 1).value());
    add_noise(first, added, luma, chroma);
    add_noise(second, added, luma, chroma);
    noise.add(first, &second);
  }
  return noise.finish();
}

// A ramp of brightness with noise.
Frame ramp(const Added& added, NoiseField& luma, NoiseField& chroma) {
  Frame frame = blank_frame(PixelLayout::yuv420, {640, 320}, {});
  for (int x = 0; x < 640; ++x) frame.planes[0].col(x).setTo(30 + x * 190 / 640);
  frame.planes[1].setTo(120);
  frame.planes[2].setTo(130);
  add_noise(frame, added, luma, chroma);
  return frame;
}

NoiseFound found_on_ramp(const Added& added) {
  Noise noise;
  NoiseField luma({640, 320}, added, 3), chroma({320, 160}, {.temporal_correlation = added.temporal_correlation}, 4);
  for (int n = 0; n < 3; ++n) {
    const Frame first = ramp(added, luma, chroma);
    const Frame second = ramp(added, luma, chroma);
    noise.add(first, &second);
  }
  return noise.finish();
}

}  // namespace

TEST_CASE("noise added to synthetic footage is found within 10 percent over brightness") {
  for (const Added& added : {Added{2.5, 2.5}, Added{4, 2}, Added{2, 3.5}}) {
    const NoiseFound found = found_in_sample(added);
    CAPTURE(added.sd_dark);
    CAPTURE(found.sd_dark.value);
    CAPTURE(found.sd_bright.value);
    CAPTURE(found.sd_bright.sd);
    CAPTURE(found.correlation_length_px.value);
    CAPTURE(found.temporal_correlation.value);
    REQUIRE_MESSAGE(found.sd_dark.is_known, found.sd_dark.why);
    for (const double b : {0.2, 0.4, 0.6, 0.8}) {
      const auto sd_at = [b](double dark, double bright) {
        return std::sqrt(dark * dark * (1 - b) + bright * bright * b);
      };
      const double true_sd = sd_at(added.sd_dark, added.sd_bright);
      CHECK(std::abs(sd_at(found.sd_dark.value, found.sd_bright.value) - true_sd) < 0.1 * true_sd);
    }
    CHECK(found.correlation_length_px.value < 0.35);  // white noise: neighbours share 2 percent at 0.35
    CHECK(found.temporal_correlation.value < 0.15);   // clouds that hardly move look like noise that lasts
  }
}

TEST_CASE("noise that neighbours share, and that lasts, is told so") {
  for (const double correlation_length_px : {0.6, 1.0, 1.3}) {
    const NoiseFound found =
        found_on_ramp({.sd_dark = 3, .sd_bright = 3, .correlation_length_px = correlation_length_px});
    CAPTURE(correlation_length_px);
    CHECK(std::abs(found.correlation_length_px.value - correlation_length_px) <
          0.13 * correlation_length_px);  // wide noise is partly taken for brightness that varies
    CHECK(std::abs(found.sd_dark.value - 3) < 0.3);
    CHECK(std::abs(found.sd_bright.value - 3) < 0.3);
  }
  for (const double temporal_correlation : {0.3, 0.7}) {
    const NoiseFound found =
        found_on_ramp({.sd_dark = 3, .sd_bright = 2, .sd_chroma = 1.5, .temporal_correlation = temporal_correlation});
    REQUIRE_MESSAGE(found.temporal_correlation.is_known, found.temporal_correlation.why);
    CHECK(std::abs(found.temporal_correlation.value - temporal_correlation) < 0.05);
    CHECK(std::abs(found.sd_chroma.value - 1.5) < 0.15);
  }
}

TEST_CASE("texture that moves little does not count as noise that lasts") {
  // Smooth waves that stand still under white noise: half of what a block varies by lasts.
  Noise noise;
  cv::RNG random(21);
  cv::Mat waves(320, 640, CV_32FC1);
  for (int y = 0; y < waves.rows; ++y)
    for (int x = 0; x < waves.cols; ++x)
      waves.at<float>(y, x) = static_cast<float>(50 + 0.2 * x + 1.7 * std::sin(0.55 * x) * std::cos(0.5 * y));
  const auto frame = [&] {
    Frame made = blank_frame(PixelLayout::gray, {640, 320}, {});
    cv::Mat white(waves.size(), CV_32FC1);
    random.fill(white, cv::RNG::NORMAL, 0, 2);
    cv::Mat(waves + white).convertTo(made.planes[0], CV_8U);
    return made;
  };
  for (int n = 0; n < 3; ++n) {
    const Frame first = frame(), second = frame();
    noise.add(first, &second);
  }
  const NoiseFound found = noise.finish();
  REQUIRE(found.sd_dark.is_known);
  CHECK(std::abs(found.sd_dark.value - 2) < 0.2);
  CHECK(std::abs(found.sd_bright.value - 2) < 0.2);
  REQUIRE(found.temporal_correlation.is_known);
  CHECK(found.temporal_correlation.value < 0.06);
}

TEST_CASE("where rounding to codes is all the noise there is, its spread is not known") {
  Noise noise;
  const auto frame = [](double moved) {
    Frame made = blank_frame(PixelLayout::gray, {640, 320}, {});
    for (int y = 0; y < 320; ++y)
      for (int x = 0; x < 640; ++x)
        made.planes[0].at<uchar>(y, x) = static_cast<uchar>(std::lround(40 + 0.23 * x + 0.11 * y + moved));
    return made;
  };
  const Frame first = frame(0), second = frame(0.4);
  noise.add(first, &second);
  const NoiseFound found = noise.finish();
  CHECK_FALSE(found.correlation_length_px.is_known);
  CHECK_FALSE(found.correlation_length_px.why.empty());
}

TEST_CASE("the rest of blurred noise in a block is as many random blocks have it") {
  cv::RNG random(5);
  for (const double correlation_length_px : {0.0, 0.8, 1.6}) {
    cv::Mat noise(1600, 1600, CV_32FC1);
    random.fill(noise, cv::RNG::NORMAL, 0, 1);
    if (correlation_length_px > 0) cv::GaussianBlur(noise, noise, {}, correlation_length_px);
    cv::Scalar mean, deviation;
    cv::meanStdDev(noise, mean, deviation);
    noise /= deviation[0];
    double squares = 0, products = 0;
    // The plane by OpenCV's least squares.
    cv::Mat design(256, 3, CV_32FC1), inverse;
    for (int i = 0; i < 256; ++i) {
      design.at<float>(i, 0) = 1;
      design.at<float>(i, 1) = static_cast<float>(i % 16);
      design.at<float>(i, 2) = static_cast<float>(i / 16);
    }
    cv::invert(design, inverse, cv::DECOMP_SVD);
    for (int y = 0; y < 1600; y += 16) {
      for (int x = 0; x < 1600; x += 16) {
        const cv::Mat block = noise(cv::Rect(x, y, 16, 16)).clone().reshape(1, 256);
        const cv::Mat rest = cv::Mat(block - design * (inverse * block)).reshape(1, 16);
        squares += rest.dot(rest);
        products += rest.colRange(0, 15).clone().dot(rest.colRange(1, 16).clone());
      }
    }
    const BlockRest expected = block_rest(correlation_length_px, 16);
    CHECK(expected.variance == doctest::Approx(squares / 10000 / 253).epsilon(0.02));  // 10,000 blocks
    CHECK(std::abs(expected.correlation - products / 10000 / 240) < 0.01);
  }
}

TEST_CASE("a block is measured as if it were alone, whatever lies beside it") {
  cv::RNG random(11);
  Frame frame = blank_frame(PixelLayout::yuv444, {11 * kNoiseBlock_px + 3, 3 * kNoiseBlock_px}, {}), next = frame;
  for (Frame* const each : {&frame, &next}) {
    each->planes = {each->planes[0].clone(), each->planes[1].clone(), each->planes[2].clone()};
    for (cv::Mat& plane : each->planes) random.fill(plane, cv::RNG::UNIFORM, 17, 235);
  }
  frame.planes[0].at<uchar>(9, 2 * kNoiseBlock_px) = 16;  // clipped: the third block of the second row is left out
  const auto block_of = [](const Frame& whole, const cv::Rect& part) {
    Frame block = whole;
    for (cv::Mat& plane : block.planes) plane = plane(part);
    return block;
  };
  std::vector<NoiseBlock> alone;
  for (int y = 0; y < 3; ++y)
    for (int x = 0; x < 11; ++x) {
      const cv::Rect part(x * kNoiseBlock_px, y * kNoiseBlock_px, kNoiseBlock_px, kNoiseBlock_px);
      const Frame after = block_of(next, part);
      for (const NoiseBlock& block : noise_blocks(block_of(frame, part), &after)) alone.push_back(block);
    }
  const std::vector<NoiseBlock> together = noise_blocks(frame, &next);
  REQUIRE(alone.size() == 32);
  REQUIRE(together.size() == alone.size());
  for (std::size_t i = 0; i < alone.size(); ++i) {
    CAPTURE(i);
    CHECK(together[i].mean == alone[i].mean);
    CHECK(together[i].variance == alone[i].variance);
    CHECK(together[i].neighbours == alone[i].neighbours);
    CHECK(together[i].next_variance == alone[i].next_variance);
    CHECK(together[i].covariance == alone[i].covariance);
    CHECK(together[i].chroma == alone[i].chroma);
    CHECK(together[i].change_neighbours == alone[i].change_neighbours);
  }
  // Uniform codes from 17 to 234 have this variance; 64 of them scatter by some 8 %, the mean of 32 blocks by 2 %.
  double sum = 0;
  for (const NoiseBlock& block : together) sum += block.variance / static_cast<double>(together.size());
  CHECK(sum == doctest::Approx((218.0 * 218 - 1) / 12).epsilon(0.08));
}
