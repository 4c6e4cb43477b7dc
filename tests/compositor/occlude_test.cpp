// SPDX-License-Identifier: MIT
#include "compositor/occlude.h"

#include <doctest/doctest.h>

#include "compositor/synthetic_layers.h"

namespace sigs::test {

TEST_CASE("a layer is cut to the part inside the bounds") {
  const Layer layer = cloudy_layer({-10, 5, 40, 30}, 2);
  const Layer cut = clipped(layer, {0, 0, 20, 20});
  CHECK(cut.rect == cv::Rect(0, 5, 20, 15));
  CHECK(same_bytes(cut.color, layer.color(cv::Rect(10, 0, 20, 15))));
  CHECK(same_bytes(cut.coverage, layer.coverage(cv::Rect(10, 0, 20, 15))));
  CHECK(clipped(layer, {100, 100, 20, 20}).empty());
  CHECK(clipped(layer, {30, 5, 20, 20}).empty());
  CHECK(clipped(Layer{}, {0, 0, 20, 20}).empty());
}

TEST_CASE("the own body hides as much as its mask says") {
  const Layer layer = even_layer({2, 3, 4, 4}, {0.25F, 0.5F, 0.75F, 1});
  cv::Mat body = cv::Mat::zeros(20, 20, CV_32FC1);
  body.at<float>(3, 2) = 1;
  body.at<float>(3, 3) = 0.25F;
  const Layer out = occluded_by_body(layer, body);
  CHECK(out.rect == layer.rect);
  CHECK(out.color.at<cv::Vec4f>(0, 0) == cv::Vec4f(0, 0, 0, 0));
  CHECK(out.coverage.at<float>(0, 0) == 0);
  CHECK(out.color.at<cv::Vec4f>(0, 1) == cv::Vec4f(0.25F, 0.5F, 0.75F, 1) * 0.75F);
  CHECK(out.coverage.at<float>(0, 1) == 0.75F);
  CHECK(out.color.at<cv::Vec4f>(1, 1) == cv::Vec4f(0.25F, 0.5F, 0.75F, 1));
  // The layer that was given stays as it was.
  CHECK(layer.coverage.at<float>(0, 0) == 1);
}

TEST_CASE("without an own body nothing is hidden and nothing copied") {
  const Layer layer = cloudy_layer({2, 3, 20, 20}, 9);
  const Layer out = occluded_by_body(layer, {});
  CHECK(out.color.data == layer.color.data);
  CHECK(occluded_by_body(Layer{}, cv::Mat::zeros(5, 5, CV_32FC1)).empty());
}

TEST_CASE("a nearer layer hides by its opacity where it lies over the farther one") {
  cv::Mat coverage(10, 10, CV_32FC1, cv::Scalar(0.5));
  const cv::Rect rect(20, 20, 10, 10);
  occlude_coverage(coverage, rect, even_layer({25, 18, 10, 6}, {0, 0, 0, 0.75F}));
  for (int y = 20; y < 30; ++y)
    for (int x = 20; x < 30; ++x) {
      const bool under = x >= 25 && y < 24;
      REQUIRE(coverage.at<float>(y - 20, x - 20) == (under ? 0.125F : 0.5F));
    }
  occlude_coverage(coverage, rect, Layer{});
  occlude_coverage(coverage, rect, even_layer({100, 100, 5, 5}, {1, 1, 1, 1}));
  CHECK(coverage.at<float>(9, 9) == 0.5F);
}

}  // namespace sigs::test
