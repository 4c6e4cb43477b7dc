// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <string>

#include "support/test_data.h"

namespace sigs::test {

namespace {

std::filesystem::path footage(const char* name) {
  return source_dir() / "assets/footage" / name;
}

cv::Mat own_body() {
  return cv::imread(footage("sample_own_body.png").string(), cv::IMREAD_UNCHANGED);
}

}  // namespace

TEST_CASE("the own body mask has one byte for each pixel of the footage") {
  REQUIRE_FALSE(own_body().empty());
  CHECK(own_body().type() == CV_8UC1);
  CHECK(own_body().size() == cv::Size(1280, 960));
}

TEST_CASE("the own body lies at the lower edge of the image and covers no sky") {
  const cv::Mat mask = own_body();
  REQUIRE_FALSE(mask.empty());
  CHECK(cv::countNonZero(mask.rowRange(0, 480)) == 0);
  CHECK(mask.at<uchar>(959, 640) == 255);
  CHECK(mask.at<uchar>(959, 5) == 0);
  CHECK(mask.at<uchar>(959, 1274) == 0);
  const double share = cv::sum(mask)[0] / 255 / static_cast<double>(mask.total());
  // A nose and a boom: more than the boom alone, less than a third of the ground.
  CHECK(share > 0.01);
  CHECK(share < 0.16);
}

TEST_CASE("the edge of the own body mask is soft") {
  const cv::Mat mask = own_body();
  REQUIRE_FALSE(mask.empty());
  const int partly = cv::countNonZero((mask > 20) & (mask < 235));
  const int fully = cv::countNonZero(mask == 255);
  CHECK(partly > 500);  // an outline of some hundred pixels, at least one pixel wide
  CHECK(partly < fully / 4);
}

TEST_CASE("the sample clip is an mp4 of moderate size") {
  const auto size = std::filesystem::file_size(footage("sample.mp4"));
  CHECK(size > 500'000);
  CHECK(size <= 6 * 1024 * 1024);
  std::ifstream in(footage("sample.mp4"), std::ios::binary);
  std::string head(12, '\0');
  in.read(head.data(), 12);
  CHECK(head.substr(4, 4) == "ftyp");  // ISO/IEC 14496-12
}

}  // namespace sigs::test
