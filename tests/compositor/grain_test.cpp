// SPDX-License-Identifier: MIT
#include "compositor/float_patch.h"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <thread>
#include <vector>

#include "compositor/blend.h"
#include "compositor/synthetic_frames.h"
#include "compositor/synthetic_layers.h"

namespace sigs::test {
namespace {

const cv::Rect kLarge(-40, 17, 640, 512);

double variance_of(const cv::Mat& values) {
  cv::Scalar mean;
  cv::Scalar sd;
  cv::meanStdDev(values, mean, sd);
  return sd[0] * sd[0];
}

double correlation_of(const cv::Mat& a, const cv::Mat& b) {
  cv::Mat x;
  cv::Mat y;
  a.convertTo(x, CV_64F);
  b.convertTo(y, CV_64F);
  x -= cv::mean(x)[0];
  y -= cv::mean(y)[0];
  return x.dot(y) / std::sqrt(x.dot(x) * y.dot(y));
}

double correlation_at(const cv::Mat& field, cv::Point by) {
  const cv::Rect first(0, 0, field.cols - by.x, field.rows - by.y);
  return correlation_of(field(first), field(first + by));
}

Sort sort_named(const std::string& name) {
  for (const Sort& sort : all_sorts())
    if (sort.name == name) return sort;
  FAIL("no such layout");
  return {};
}

// A flat surface of a code, in front of all of an even image, with grain.
Frame with_grain(const Sort& sort, const GrainSettings& grain, double display, float opacity, std::int64_t frame = 3) {
  const cv::Size size(640, 512);
  Frame image = even(sort, size, 100);
  const auto light = static_cast<float>(linear_value(display)) * opacity;
  FloatPatch patch =
      blended_patch(image, even_layer({{0, 0}, size}, {light, light, light, opacity}), BlendChoice::display, 0, {});
  add_grain(patch, grain, frame);
  write_patch(patch, image);
  return image;
}

}  // namespace

TEST_CASE("a field of noise has mean 0 and variance 1, and its neighbours correlate as a Gaussian says") {
  for (const double correlation_length_px : {0.0, 0.5, 0.8, 1.5}) {
    CAPTURE(correlation_length_px);
    const cv::Mat field = noise_field({.correlation_length_px = correlation_length_px}, 0, 5, kLarge);
    // Standard error of the mean: sqrt(4 pi spread^2 / samples), of the variance some sqrt(2 * 2 pi spread^2 /
    // samples).
    CHECK(std::abs(cv::mean(field)[0]) < 0.03);
    CHECK(variance_of(field) == doctest::Approx(1).epsilon(0.03));
    for (const int n : {1, 2, 3}) {
      // From 0.8 px on samples of a Gaussian correlate as the continuous one does; below, its cut shows.
      if (correlation_length_px > 0 && correlation_length_px < 0.8) continue;
      const double wanted =
          correlation_length_px > 0 ? std::exp(-n * n / (4 * correlation_length_px * correlation_length_px)) : 0;
      CHECK(std::abs(correlation_at(field, {n, 0}) - wanted) < 0.03);
      CHECK(std::abs(correlation_at(field, {0, n}) - wanted) < 0.03);
    }
    CHECK(std::abs(correlation_at(field, {100, 3})) < 0.03);
  }
}

TEST_CASE("noise persists from frame to frame as asked") {
  for (const double temporal_correlation : {0.0, 0.3, 0.6, 0.9}) {
    CAPTURE(temporal_correlation);
    const GrainSettings grain{.correlation_length_px = 0.8, .temporal_correlation = temporal_correlation};
    const cv::Mat now = noise_field(grain, 0, 40, kLarge);
    CHECK(variance_of(now) == doctest::Approx(1).epsilon(0.03));
    CHECK(std::abs(correlation_of(now, noise_field(grain, 0, 41, kLarge)) - temporal_correlation) < 0.03);
    CHECK(std::abs(correlation_of(now, noise_field(grain, 0, 42, kLarge)) -
                   temporal_correlation * temporal_correlation) < 0.03);
  }
}

TEST_CASE("planes, seeds and distant frames are independent, and frames below 0 have noise too") {
  const cv::Mat first = noise_field({.seed = 7}, 0, 0, kLarge);
  CHECK(std::abs(correlation_of(first, noise_field({.seed = 7}, 1, 0, kLarge))) < 0.01);
  CHECK(std::abs(correlation_of(first, noise_field({.seed = 8}, 0, 0, kLarge))) < 0.01);
  CHECK(std::abs(correlation_of(first, noise_field({.seed = 7}, 0, 1, kLarge))) < 0.01);
  CHECK(std::abs(correlation_of(first, noise_field({.seed = 7}, 0, -1, kLarge))) < 0.01);
}

TEST_CASE("any part of a field by itself, on any thread, is that part of the whole") {
  const GrainSettings grain{.correlation_length_px = 1.2, .temporal_correlation = 0.5, .seed = 11};
  const cv::Mat whole = noise_field(grain, 0, 9, kLarge);
  std::array<cv::Mat, 4> parts;
  std::vector<std::thread> threads;
  for (std::size_t i = 0; i < parts.size(); ++i)
    threads.emplace_back([&, i] { parts[i] = noise_field(grain, 0, 9, kLarge); });
  for (std::thread& thread : threads) thread.join();
  for (const cv::Mat& part : parts) CHECK(same_bytes(part, whole));
  const cv::Rect small(13, 40, 31, 27);
  CHECK(cv::norm(noise_field(grain, 0, 9, small), whole(small - kLarge.tl()), cv::NORM_INF) < 1e-5);
}

TEST_CASE("an opaque surface gets the footage's variance at its brightness, rounding included") {
  const Sort sort = sort_named("4:2:0 left BT.709 limited");
  const GrainSettings grain{.sd_dark = 1.5, .sd_bright = 5, .sd_chroma = 2.5, .correlation_length_px = 0.8};
  for (const double display : {0.2, 0.5, 0.8}) {
    CAPTURE(display);
    const Frame image = with_grain(sort, grain, display, 1);
    const double wanted = 1.5 * 1.5 + display * (5.0 * 5.0 - 1.5 * 1.5);
    CHECK(variance_of(image.planes[0]) == doctest::Approx(wanted).epsilon(0.03));
    CHECK(cv::mean(image.planes[0])[0] == doctest::Approx(16 + 219 * display).epsilon(0.002));
    for (const std::size_t plane : {1U, 2U}) {
      CHECK(variance_of(image.planes[plane]) == doctest::Approx(2.5 * 2.5).epsilon(0.03));
      CHECK(std::abs(cv::mean(image.planes[plane])[0] - 128) < 0.1);
    }
  }
}

TEST_CASE("where the footage shows through, its own noise and the added one make the whole") {
  const Sort sort = sort_named("gray BT.709 full");
  for (const float opacity : {0.3F, 0.7F}) {
    const Frame image = with_grain(sort, {.sd_dark = 4, .sd_bright = 4}, 0.4, opacity);
    const double added = 1 - (1 - double{opacity}) * (1 - double{opacity});
    // The even image below has no noise. Rounding's 1/12 is left out by its share, and comes back whole.
    CHECK(variance_of(image.planes[0]) == doctest::Approx((16 - 1.0 / 12) * added + 1.0 / 12).epsilon(0.03));
  }
}

namespace {

// Gray, of a code, with white noise and noise that is the same along each row.
Frame noisy(double code, double sd, double sd_of_rows = 0) {
  Frame image = even(sort_named("gray BT.709 full"), {320, 256}, 100);
  cv::RNG random(11);
  cv::Mat noise(image.planes[0].size(), CV_32FC1), rows(noise.rows, 1, CV_32FC1);
  random.fill(noise, cv::RNG::NORMAL, 0, sd);
  random.fill(rows, cv::RNG::NORMAL, 0, sd_of_rows);
  cv::Mat(noise + cv::repeat(rows, 1, noise.cols) + code).convertTo(image.planes[0], CV_8U);
  return image;
}

constexpr int kBorder = 30;

// A flat surface of a code before all but the border, with noise.
cv::Mat covered(const Frame& footage, double code, const GrainSettings& grain, float opacity = 1,
                int further_margin_px = 0) {
  Frame image = cloned(footage);
  const cv::Rect place(kBorder, kBorder, 320 - 2 * kBorder, 256 - 2 * kBorder);
  const auto light = static_cast<float>(linear_value(code / 255)) * opacity;
  FloatPatch patch = blended_patch(image, even_layer(place, {light, light, light, opacity}), BlendChoice::display,
                                   grain_margin_px(image.layout, grain) + further_margin_px, {});
  add_grain(patch, grain, 3);
  write_patch(patch, image);
  return image.planes[0](place).clone();
}

// What OpenCV's Gaussian leaves of it.
cv::Mat fine(const cv::Mat& codes) {
  cv::Mat sharp, mean;
  codes.convertTo(sharp, CV_32F);
  cv::GaussianBlur(sharp, mean, {}, 2);
  return sharp - mean;
}

GrainSettings of_footage(double sd_dark, double sd_bright) {
  return {.source = GrainSource::footage, .sd_dark = sd_dark, .sd_bright = sd_bright};
}

}  // namespace

TEST_CASE("the footage's own noise stays where an intruder hides it, rows and all") {
  const Frame image = noisy(100, 2.5, 1.5);
  const cv::Mat before = fine(image.planes[0])({kBorder, kBorder, 260, 196});
  const double sd = std::hypot(2.5, 1.5);
  for (const float opacity : {1.0F, 0.6F}) {
    const cv::Mat after = covered(image, 180, of_footage(sd, sd), opacity);
    CHECK(correlation_of(after, before) > (opacity < 1 ? 0.97 : 0.99));
    CHECK(variance_of(after) == doctest::Approx(sd * sd).epsilon(0.1));
    CHECK(cv::mean(after)[0] == doctest::Approx(100 + 80 * opacity).epsilon(0.003));
  }
  // Made noise has none of it.
  CHECK(std::abs(correlation_of(covered(image, 180, {.sd_dark = sd, .sd_bright = sd}), before)) < 0.03);
}

TEST_CASE("the footage's own noise grows with brightness as the footage's does") {
  // Variances: 1 + 15 / 4 at a quarter of white, 1 + 45 / 4 at three quarters.
  const cv::Mat after = covered(noisy(255.0 / 4, std::sqrt(1 + 15.0 / 4)), 255 * 0.75, of_footage(1, 4));
  CHECK(variance_of(after) == doctest::Approx(1 + 45.0 / 4).epsilon(0.1));
}

TEST_CASE(
    "texture that an intruder hides does not show through it, and has noise of the footage's variance before it") {
  Frame image = noisy(120, 2);
  for (int y = 0; y < image.planes[0].rows; ++y)
    for (int x = 0; x < image.planes[0].cols; ++x)
      image.planes[0].at<uchar>(y, x) = cv::saturate_cast<uchar>(image.planes[0].at<uchar>(y, x) + (x / 3 % 2) * 80);
  const cv::Mat texture = fine(image.planes[0])({kBorder, kBorder, 260, 196});
  const cv::Mat after = covered(image, 60, of_footage(2, 2));
  CHECK(variance_of(texture) > 1000);
  CHECK(variance_of(after) == doctest::Approx(4).epsilon(0.1));
  CHECK(std::abs(correlation_of(after, texture)) < 0.15);  // it adds a hundredth of the variance
}

TEST_CASE("before what is clipped noise is made") {
  for (const int code : {0, 255}) {
    Frame image = even(sort_named("gray BT.709 full"), {320, 256}, 100);
    image.planes[0].setTo(code);
    CHECK(variance_of(covered(image, 120, of_footage(3, 3))) == doctest::Approx(9).epsilon(0.05));
  }
}

TEST_CASE("the footage's own noise does not depend on how much around the layer is looked at") {
  const Frame image = noisy(100, 3);
  CHECK(cv::norm(covered(image, 50, of_footage(3, 3)), covered(image, 50, of_footage(3, 3), 1, 9), cv::NORM_INF) == 0);
  CHECK(grain_margin_px(PixelLayout::gray, of_footage(0, 0)) == 0);
}

TEST_CASE("the noise of red, green and blue that an intruder hides stays in each of them") {
  Frame image = even(sort_named("RGB"), {320, 256}, 100);
  cv::RNG random(5);
  std::array<cv::Mat, 3> before;
  const cv::Rect place(kBorder, kBorder, 260, 196);
  for (std::size_t c = 0; c < 3; ++c) {
    cv::Mat noise(image.planes[c].size(), CV_32FC1);
    random.fill(noise, cv::RNG::NORMAL, 100, 3);
    noise.convertTo(image.planes[c], CV_8U);
    before[c] = fine(image.planes[c])(place).clone();
  }
  // Of three planes of sd 3: luma 3 |(0.2126, 0.7152, 0.0722)|, and the differences from it.
  const GrainSettings grain{.source = GrainSource::footage, .sd_dark = 2.25, .sd_bright = 2.25, .sd_chroma = 2};
  FloatPatch patch = blended_patch(image, even_layer(place, {0.5F, 0.5F, 0.5F, 1}), BlendChoice::display,
                                   grain_margin_px(image.layout, grain), {});
  add_grain(patch, grain, 3);
  write_patch(patch, image);
  for (std::size_t c = 0; c < 3; ++c) CHECK(correlation_of(image.planes[c](place), before[c]) > 0.9);
}

TEST_CASE("noise of red, green and blue is that of luma and of its two colour differences") {
  const Sort sort = sort_named("RGB");
  const Frame image = with_grain(sort, {.sd_dark = 3, .sd_bright = 3, .sd_chroma = 2}, 0.5, 1);
  cv::Mat luma;
  cv::Mat planes[3];
  for (std::size_t c = 0; c < 3; ++c) image.planes[c].convertTo(planes[c], CV_32F);
  luma = 0.2126 * planes[0] + 0.7152 * planes[1] + 0.0722 * planes[2];
  CHECK(variance_of(luma) == doctest::Approx(9).epsilon(0.03));
  CHECK(variance_of((planes[2] - luma) / 1.8556) == doctest::Approx(4).epsilon(0.03));
  CHECK(variance_of((planes[0] - luma) / 1.5748) == doctest::Approx(4).epsilon(0.03));
}

TEST_CASE("grain near black and white stays within the codes and finite") {
  for (const Sort& sort : all_sorts())
    for (const double display : {0.0, 1.0}) {
      const Frame image =
          with_grain(sort, {.sd_dark = 64, .sd_bright = 64, .sd_chroma = 64, .temporal_correlation = 0.5}, display, 1);
      CHECK(variance_of(image.planes[0]) > 100);
    }
}

}  // namespace sigs::test
