// SPDX-License-Identifier: MIT
#include "editor/geometry/image_view.h"

#include <doctest/doctest.h>

using namespace sigs::editor;

namespace {

PatchedImage example() {
  PatchedImage image{.ground = cv::Mat(40, 50, CV_8UC3), .patch = cv::Mat(7, 9, CV_8UC3), .patch_at = {11, 13}};
  cv::RNG random(3);
  random.fill(image.ground, cv::RNG::UNIFORM, 0, 128);
  random.fill(image.patch, cv::RNG::UNIFORM, 128, 256);  // no pixel of the ground
  return image;
}

}  // namespace

TEST_CASE("a patch lies over its ground, pixel by pixel") {
  const PatchedImage image = example();
  const cv::Mat ground = image.ground.clone();
  const cv::Mat whole = image.whole();
  REQUIRE(whole.size() == image.size());
  int patched = 0;
  for (int y = 0; y < whole.rows; ++y)
    for (int x = 0; x < whole.cols; ++x) {
      const bool over = x >= 11 && x < 20 && y >= 13 && y < 20;
      patched += over ? 1 : 0;
      const auto expected = over ? image.patch.at<cv::Vec3b>(y - 13, x - 11) : ground.at<cv::Vec3b>(y, x);
      CHECK(whole.at<cv::Vec3b>(y, x) == expected);
      CHECK(image.bgr_at({x, y}) == expected);
    }
  CHECK(patched == 63);
  CHECK(cv::norm(image.ground, ground, cv::NORM_INF) == 0);  // others share it
}

TEST_CASE("without a patch the ground is the image, and one channel is grey") {
  PatchedImage image = example();
  image.patch = cv::Mat();
  CHECK(image.whole().data == image.ground.data);
  CHECK(drawn_patch(image, 3).drawn.empty());
  image.ground = cv::Mat(4, 4, CV_8UC1, cv::Scalar(77));
  CHECK(image.bgr_at({3, 3}) == cv::Vec3b(77, 77, 77));
}

TEST_CASE("a patch at the image's edge is drawn up to the edge, elsewhere one block less than is reduced") {
  const cv::Mat ground(100, 101, CV_8UC3, cv::Scalar::all(0));
  const PatchedImage inside{.ground = ground, .patch = ground({10, 20, 50, 40}), .patch_at = {10, 20}};
  CHECK(drawn_patch(inside, 4).reduced == cv::Rect(12, 20, 48, 40));
  CHECK(drawn_patch(inside, 4).drawn == cv::Rect(16, 24, 40, 32));
  const PatchedImage corner{.ground = ground, .patch = ground({71, 70, 30, 30}), .patch_at = {71, 70}};
  CHECK(drawn_patch(corner, 4).reduced == cv::Rect(72, 72, 29, 28));
  CHECK(drawn_patch(corner, 4).drawn == cv::Rect(76, 76, 25, 24));
  CHECK(drawn_patch(inside, 40).drawn.empty());  // no whole block
}
