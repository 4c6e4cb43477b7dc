// SPDX-License-Identifier: MIT
#include "compositor/blur.h"

#include <doctest/doctest.h>

#include <cmath>
#include <opencv2/imgproc.hpp>

#include "compositor/made_layers.h"

namespace sigs::test {
namespace {

Layer point() {
  Layer layer = even_layer({40, 30, 1, 1}, {0.25F, 0.5F, 0.75F, 1});
  return layer;
}

struct Spread {
  double x = 0;
  double y = 0;
};

// Variance of the opacity about its middle, px squared.
Spread spread_of(const Layer& layer) {
  cv::Mat opacity;
  cv::extractChannel(layer.color, opacity, 3);
  const cv::Moments m = cv::moments(opacity);
  return {m.mu20 / m.m00, m.mu02 / m.m00};
}

}  // namespace

TEST_CASE("without blur a layer comes back bit for bit") {
  const Layer layer = cloudy_layer({-5, 7, 60, 50}, 1);
  const Layer out = blurred(layer, 0);
  CHECK(out.rect == layer.rect);
  CHECK(same_bytes(out.color, layer.color));
  CHECK(same_bytes(out.coverage, layer.coverage));
}

TEST_CASE("blur of an empty layer is empty") {
  CHECK(blurred(Layer{}, 0).empty());
  CHECK(blurred(Layer{}, 3).empty());
}

TEST_CASE("blur reaches three sigmas") {
  CHECK(blur_reach_px(0) == 0);
  CHECK(blur_reach_px(1e-6) == 1);
  CHECK(blur_reach_px(1) == 3);
  CHECK(blur_reach_px(1.1) == 4);
  CHECK(blur_reach_px(50) == 150);
}

TEST_CASE("blur keeps the energy and leaves the truth sharp") {
  for (const double sigma_px : {1e-6, 0.3, 0.7, 1.0, 2.5, 10.0, 50.0}) {
    CAPTURE(sigma_px);
    const Layer layer = cloudy_layer({10, -20, 50, 40}, 4);
    const Layer out = blurred(layer, sigma_px);
    const int reach = static_cast<int>(std::ceil(3 * sigma_px));
    CHECK(out.rect == cv::Rect(10 - reach, -20 - reach, 50 + 2 * reach, 40 + 2 * reach));
    REQUIRE(out.color.size() == out.rect.size());
    REQUIRE(out.coverage.size() == out.rect.size());
    for (int c = 0; c < 4; ++c) CHECK(cv::sum(out.color)[c] == doctest::Approx(cv::sum(layer.color)[c]).epsilon(0.001));
    CHECK(is_sound(out));
    CHECK(same_bytes(out.coverage(cv::Rect(reach, reach, 50, 40)), layer.coverage));
    CHECK(cv::countNonZero(out.coverage) == cv::countNonZero(layer.coverage));
  }
}

TEST_CASE("a blurred point spreads by sigma squared") {
  // A Gaussian cut at three sigmas has 0.973 of the whole one's variance; the kernel reaches up to one pixel farther,
  // and sampling at whole pixels adds nothing from sigma 0.8 on.
  for (const double sigma_px : {0.8, 1.0, 1.5, 2.5, 7.3, 20.0, 50.0}) {
    CAPTURE(sigma_px);
    const Spread spread = spread_of(blurred(point(), sigma_px));
    CHECK(spread.x > 0.97 * sigma_px * sigma_px);
    CHECK(spread.x < 1.001 * sigma_px * sigma_px);
    CHECK(spread.y == doctest::Approx(spread.x).epsilon(1e-4));
  }
}

TEST_CASE("a blur far below a pixel changes next to nothing and grows from there") {
  const Layer hardly = blurred(point(), 1e-6);
  CHECK(hardly.color.at<cv::Vec4f>(1, 1)[3] == doctest::Approx(1.0));
  CHECK(spread_of(hardly).x == doctest::Approx(0.0));
  double before = 0;
  for (const double sigma_px : {0.2, 0.3, 0.4, 0.5, 0.6, 0.8}) {
    const double spread = spread_of(blurred(point(), sigma_px)).x;
    CHECK(spread > before);
    before = spread;
  }
}

TEST_CASE("colour is blurred premultiplied so that nothing bleeds in") {
  // Wherever there is any opacity at all, the colour behind it is the point's own.
  const Layer out = blurred(point(), 4);
  for (int y = 0; y < out.rect.height; ++y)
    for (int x = 0; x < out.rect.width; ++x) {
      const cv::Vec4f& color = out.color.at<cv::Vec4f>(y, x);
      REQUIRE(color[3] > 0);
      REQUIRE(color[0] / color[3] == doctest::Approx(0.25).epsilon(1e-4));
      REQUIRE(color[2] / color[3] == doctest::Approx(0.75).epsilon(1e-4));
    }
}

}  // namespace sigs::test
