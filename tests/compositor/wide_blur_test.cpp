// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>
#include <string>
#include <vector>

#include "compositor/blur.h"
#include "compositor/classic.h"
#include "compositor/synthetic_layers.h"

namespace sigs::test {
namespace {

// Patches with hard edges over noise: what a blur has to smooth.
cv::Mat patches(cv::Size size, int type) {
  cv::Mat image(size, type);
  cv::RNG random(11);
  random.fill(image, cv::RNG::UNIFORM, 0, 256);
  cv::rectangle(image, {size.width / 3, size.height / 4, size.width / 3, size.height / 3}, cv::Scalar::all(255), -1);
  cv::rectangle(image, {0, 0, size.width / 5, size.height / 2}, cv::Scalar(10, 60, 0), -1);
  return image;
}

// The whole kernel, cut as OpenCV cuts it for 8 bits, in doubles.
cv::Mat blurred_in_full(const cv::Mat& image, double sigma_px) {
  cv::Mat exact;
  image.convertTo(exact, CV_64F);
  const int size = 2 * static_cast<int>(std::round(3 * sigma_px)) + 1;
  const cv::Mat kernel = cv::getGaussianKernel(size, sigma_px, CV_64F);
  cv::sepFilter2D(exact, exact, CV_64F, kernel, kernel, {-1, -1}, 0, cv::BORDER_REFLECT_101);
  exact.convertTo(exact, CV_8U);
  return exact;
}

}  // namespace

TEST_CASE("a layer blurred widely is the layer blurred in full") {
  for (const cv::Rect& rect : {cv::Rect(10, -20, 150, 90), cv::Rect(-71, 33, 7, 5), cv::Rect(3, 4, 1, 1)})
    for (const double sigma_px : {16.0, 23.7, 61.0}) {
      CAPTURE(rect.width);
      CAPTURE(sigma_px);
      const Layer layer = rect.width == 1 ? even_layer(rect, {0.25F, 0.5F, 0.75F, 1}) : cloudy_layer(rect, 3);
      const Layer full = blurred(layer, sigma_px);
      double highest = 0;
      cv::minMaxIdx(full.color.reshape(1), nullptr, &highest);
      const Layer out = widely_blurred(layer, sigma_px, full.rect);
      CHECK(out.rect == full.rect);
      CHECK(is_valid(out));
      CHECK(cv::norm(out.coverage, full.coverage, cv::NORM_INF) == 0);
      for (int c = 0; c < 4; ++c)
        CHECK(cv::sum(out.color)[c] == doctest::Approx(cv::sum(layer.color)[c]).epsilon(0.001));
      // Each way the cut is a step of exp(-4.5) = 1.1 %, which the spline makes soft: half of it at most, both ways.
      CHECK(cv::norm(out.color, full.color, cv::NORM_INF) < 0.012 * highest);
      CHECK(cv::norm(out.color, full.color, cv::NORM_L2) < 0.005 * cv::norm(full.color, cv::NORM_L2));
      CHECK(max_after_blur(layer, sigma_px) >= 0.999 * highest);
    }
}

TEST_CASE("an infinite surface keeps its colour whatever the blur") {
  for (const double sigma_px : {16.0, 40.0, 100.0}) {
    const Layer layer = even_layer({-400, -400, 900, 900}, {0.25F, 0.5F, 0.75F, 1});
    const Layer out = widely_blurred(layer, sigma_px, {0, 0, 64, 48});
    double low = 0;
    double high = 0;
    cv::minMaxIdx(out.color.reshape(1), &low, &high);
    CHECK(low == doctest::Approx(0.25).epsilon(1e-4));
    CHECK(high == doctest::Approx(1).epsilon(1e-4));
  }
}

TEST_CASE("any sigma is possible, and the result tends to zero") {
  const Layer layer = cloudy_layer({5, 5, 40, 30}, 2);
  double before = 1;
  for (const double sigma_px : {20.0, 500.0, 1e6, 1e9, 1e30}) {
    const double maximum = max_after_blur(layer, sigma_px);
    CHECK(maximum < before);
    before = maximum;
    const Layer out = widely_blurred(layer, sigma_px, {0, 0, 320, 240});
    CHECK(is_valid(out));
    CHECK(cv::norm(out.color, cv::NORM_INF) <= maximum * 1.000001);
  }
}

TEST_CASE("a point spreads as a Gaussian, up to a million pixels") {
  const Layer point = even_layer({0, 0, 1, 1}, {0.25F, 0.5F, 0.75F, 1});
  for (const double sigma_px : {16.0, 40.0, 500.0, 1e4, 1e6}) {
    CAPTURE(sigma_px);
    // Of a Gaussian cut at three sigmas each way, which is higher by what the cut leaves out.
    const double peak =
        1 / (2 * std::numbers::pi * sigma_px * sigma_px * std::pow(std::erf(3 / std::numbers::sqrt2), 2));
    for (const double away : {0.0, 0.7, 1.5, 2.2, 2.7}) {
      const int x = static_cast<int>(away * sigma_px);
      const Layer out = widely_blurred(point, sigma_px, {x, 0, 3, 2});
      const double wanted = peak * std::exp(-0.5 * std::pow(x / sigma_px, 2));
      // The spline between places a quarter of sigma apart: to half a percent of the peak.
      CHECK(std::abs(out.color.at<cv::Vec4f>(0, 0)[3] - wanted) < 0.005 * peak);
    }
    for (const int x : {static_cast<int>(3.6 * sigma_px), static_cast<int>(-4 * sigma_px)})
      CHECK(cv::norm(widely_blurred(point, sigma_px, {x, 0, 3, 2}).color, cv::NORM_INF) == 0);
  }
}

TEST_CASE("energy is kept to a thousandth on both sides of sigma 16, without a discontinuity there") {
  const Layer layer = cloudy_layer({10, -20, 50, 40}, 4);
  const Layer below = blurred(layer, kWideSigma_px);
  for (const double sigma_px : {16.0, 16.0001, 17.0, 60.0, 200.0}) {
    CAPTURE(sigma_px);
    const int reach = static_cast<int>(4 * sigma_px);
    const cv::Rect all(10 - reach, -20 - reach, 50 + 2 * reach, 40 + 2 * reach);
    const Layer out = widely_blurred(layer, sigma_px, all);
    for (int c = 0; c < 4; ++c) CHECK(cv::sum(out.color)[c] == doctest::Approx(cv::sum(layer.color)[c]).epsilon(0.001));
    if (sigma_px > 16.5) continue;
    const cv::Mat inside = out.color(cv::Rect(below.rect.tl() - all.tl(), below.rect.size()));
    double highest = 0;
    cv::minMaxIdx(below.color.reshape(1), nullptr, &highest);
    CHECK(cv::norm(inside, below.color, cv::NORM_INF) < 0.012 * highest);  // the cut at three sigmas, made soft
    CHECK(cv::norm(inside, below.color, cv::NORM_L2) < 0.005 * cv::norm(below.color, cv::NORM_L2));
  }
}

TEST_CASE("a whole image is blurred within a code value of the kernel in full") {
  for (const int type : {CV_8UC3, CV_8UC1})
    for (const cv::Size size : {cv::Size(203, 151), cv::Size(40, 97), cv::Size(1, 30), cv::Size(1, 1)})
      for (const double sigma_px : {16.01, 24.0, 50.0, 150.0, 700.0}) {
        CAPTURE(size.width);
        CAPTURE(sigma_px);
        const cv::Mat image = patches(size, type);
        const cv::Mat out = gaussian_blurred(image, sigma_px);
        CHECK(out.type() == type);
        CHECK(cv::norm(out, blurred_in_full(image, sigma_px), cv::NORM_INF) <= 1);
      }
}

TEST_CASE("an image blurred beyond its size is its mean") {
  const cv::Mat image = patches({160, 120}, CV_8UC3);
  // Mirrored without its border twice: the mean in which border samples count half.
  const cv::Mat wanted = blurred_in_full(image, 500);
  for (const double sigma_px : {1e3, 1e6, 1e9, 1e30})
    CHECK(cv::norm(gaussian_blurred(image, sigma_px), wanted, cv::NORM_INF) <= 1);
}

TEST_CASE("pure green stays pure green however far it is blurred") {
  const cv::Mat green(90, 120, CV_8UC3, cv::Scalar(0, 255, 0));
  for (const double sigma_px : {17.0, 80.0, 1e5}) CHECK(same_bytes(gaussian_blurred(green, sigma_px), green));
}

}  // namespace sigs::test
