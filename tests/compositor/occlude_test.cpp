// SPDX-License-Identifier: MIT
#include "compositor/blend.h"

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

TEST_CASE("the own body occludes by its mask's value") {
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
  // The given layer is unchanged.
  CHECK(layer.coverage.at<float>(0, 0) == 1);
}

TEST_CASE("without an own body nothing is hidden and nothing copied") {
  const Layer layer = cloudy_layer({2, 3, 20, 20}, 9);
  const Layer out = occluded_by_body(layer, {});
  CHECK(out.color.data == layer.color.data);
  CHECK(occluded_by_body(Layer{}, cv::Mat::zeros(5, 5, CV_32FC1)).empty());
}

}  // namespace sigs::test
