// SPDX-License-Identifier: MIT
#include "editor/geometry/shown_image.h"

#include <doctest/doctest.h>

using namespace sigs::editor;

namespace {

cv::Mat random_pixels(int rows, int cols, int type, int low, int high) {
  cv::Mat pixels(rows, cols, type);
  cv::RNG(3).fill(pixels, cv::RNG::UNIFORM, low, high);
  return pixels;
}

}  // namespace

TEST_CASE("a patch lies over its ground, pixel by pixel") {
  const cv::Mat ground = random_pixels(40, 50, CV_8UC3, 0, 128);
  const cv::Mat before = ground.clone();
  const cv::Mat patch = random_pixels(7, 9, CV_8UC3, 128, 256);  // no pixel of the ground
  const PatchedImage image{.ground = ground, .patch = patch, .patch_at = {11, 13}};
  const cv::Mat whole = image.whole();
  REQUIRE(whole.size() == image.size());
  int patched = 0;
  for (int y = 0; y < whole.rows; ++y)
    for (int x = 0; x < whole.cols; ++x) {
      const bool over = x >= 11 && x < 20 && y >= 13 && y < 20;
      patched += over ? 1 : 0;
      const auto expected = over ? patch.at<cv::Vec3b>(y - 13, x - 11) : before.at<cv::Vec3b>(y, x);
      CHECK(whole.at<cv::Vec3b>(y, x) == expected);
      CHECK(image.bgr_at({x, y}) == expected);
    }
  CHECK(patched == 63);
  CHECK(cv::norm(ground, before, cv::NORM_INF) == 0);  // others share it
  for (const cv::Rect& part :
       {cv::Rect(0, 0, 11, 13), cv::Rect(12, 14, 3, 2), cv::Rect(5, 6, 20, 20), cv::Rect(19, 19, 31, 21)})
    CHECK(cv::norm(image.part(part), whole(part), cv::NORM_INF) == 0);
}

TEST_CASE("without a patch the ground is the image, and one channel is grey") {
  const cv::Mat ground = random_pixels(40, 50, CV_8UC3, 0, 256);
  const PatchedImage image{.ground = ground, .patch = {}, .patch_at = {}};
  CHECK(image.whole().data == ground.data);
  CHECK(drawn_patch(image, 3).drawn.empty());
  CHECK_FALSE(image.ground.is_grey());
  const PatchedImage grey{.ground = cv::Mat(4, 4, CV_8UC1, cv::Scalar(77)), .patch = {}, .patch_at = {}};
  CHECK(grey.ground.is_grey());
  CHECK(grey.bgr_at({3, 3}) == cv::Vec3b(77, 77, 77));
  CHECK(PatchedImage().empty());
  CHECK(PatchedImage().whole().empty());
}

TEST_CASE("a patch at the image's edge is drawn up to the edge, elsewhere one block less than is reduced") {
  const cv::Mat ground(100, 101, CV_8UC3, cv::Scalar::all(0));
  const PatchedImage inside{.ground = ground, .patch = cv::Mat(ground({10, 20, 50, 40})), .patch_at = {10, 20}};
  CHECK(drawn_patch(inside, 4).reduced == cv::Rect(12, 20, 48, 40));
  CHECK(drawn_patch(inside, 4).drawn == cv::Rect(16, 24, 40, 32));
  const PatchedImage corner{.ground = ground, .patch = cv::Mat(ground({71, 70, 30, 30})), .patch_at = {71, 70}};
  CHECK(drawn_patch(corner, 4).reduced == cv::Rect(72, 72, 29, 28));
  CHECK(drawn_patch(corner, 4).drawn == cv::Rect(76, 76, 25, 24));
  CHECK(drawn_patch(inside, 40).drawn.empty());  // no whole block
}
