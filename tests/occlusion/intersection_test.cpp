// SPDX-License-Identifier: MIT
#include "occlusion/detect.h"

#include <doctest/doctest.h>

#include "occlusion/synthetic_masks.h"

namespace sigs::test {

TEST_CASE("the agreement of two masks is their intersection over union") {
  const cv::Mat a = drawn({"##..", "##..", "...."});
  CHECK(intersection_over_union(a, drawn({".##.", ".##.", "...."})) == 2.0 / 6);
  CHECK(intersection_over_union(a, drawn({"##..", "....", "...."})) == 2.0 / 4);
  CHECK(intersection_over_union(a, drawn({"..##", "..##", "...."})) == 0);
  CHECK(intersection_over_union(a, a) == 1);
  CHECK(intersection_over_union(a, ~a) == 0);
}

TEST_CASE("two empty masks agree fully, an empty one and another do not at all") {
  const cv::Mat none = cv::Mat::zeros(3, 4, CV_8UC1);
  CHECK(intersection_over_union(none, none) == 1);
  CHECK(intersection_over_union(none, drawn({"#...", "....", "...."})) == 0);
}

TEST_CASE("agreement is the same both ways, and counted by pixels") {
  const cv::Mat a = sprinkled({40, 30}, 0.3, 1);
  const cv::Mat b = sprinkled({40, 30}, 0.6, 2);
  int both = 0;
  int either = 0;
  for (int y = 0; y < a.rows; ++y)
    for (int x = 0; x < a.cols; ++x) {
      both += a.at<uchar>(y, x) != 0 && b.at<uchar>(y, x) != 0 ? 1 : 0;
      either += a.at<uchar>(y, x) != 0 || b.at<uchar>(y, x) != 0 ? 1 : 0;
    }
  CHECK(intersection_over_union(a, b) == static_cast<double>(both) / either);
  CHECK(intersection_over_union(b, a) == static_cast<double>(both) / either);
}

TEST_CASE("a soft edge belongs to the mask from half on") {
  const cv::Mat soft = (cv::Mat_<uchar>(1, 4) << 127, 128, 255, 0);
  CHECK(intersection_over_union(soft, drawn({".##."})) == 1);
}

}  // namespace sigs::test
