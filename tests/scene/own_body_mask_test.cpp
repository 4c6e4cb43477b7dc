// SPDX-License-Identifier: MIT
#include "scene/scene_files.h"

#include <doctest/doctest.h>

#include <fstream>
#include <opencv2/imgcodecs.hpp>

#include "support/test_data.h"

using namespace sigs;

TEST_CASE("white occludes, black does not, and grey is in between") {
  const test::TemporaryFolder folder;
  cv::imwrite((folder / "m.png").string(), cv::Mat((cv::Mat_<uchar>(1, 3) << 0, 51, 255)));
  const Result<cv::Mat> mask = read_own_body_mask(folder / "m.png", {3, 1});
  REQUIRE(mask.has_value());
  CHECK(mask->at<float>(0, 0) == 0.0F);
  CHECK(mask->at<float>(0, 1) == doctest::Approx(0.2F));
  CHECK(mask->at<float>(0, 2) == doctest::Approx(1.0F));
}

TEST_CASE("a 16-bit mask has the values of the same mask in 8 bits") {
  const test::TemporaryFolder folder;
  cv::imwrite((folder / "8.png").string(), cv::Mat((cv::Mat_<uchar>(1, 3) << 0, 51, 255)));
  cv::imwrite((folder / "16.png").string(), cv::Mat((cv::Mat_<ushort>(1, 3) << 0, 51 * 257, 65535)));
  const cv::Mat difference =
      read_own_body_mask(folder / "8.png", {3, 1}).value() - read_own_body_mask(folder / "16.png", {3, 1}).value();
  CHECK(cv::norm(difference, cv::NORM_INF) < 1e-6);  // float rounding
}

TEST_CASE("a mask in colour or with an alpha channel is read by its brightness") {
  const test::TemporaryFolder folder;
  cv::imwrite((folder / "c.png").string(), cv::Mat(2, 2, CV_8UC3, cv::Scalar::all(255)));
  cv::imwrite((folder / "a.png").string(), cv::Mat(2, 2, CV_8UC4, cv::Scalar::all(255)));
  CHECK(read_own_body_mask(folder / "c.png", {2, 2}).value().at<float>(1, 1) == doctest::Approx(1.0F));
  CHECK(read_own_body_mask(folder / "a.png", {2, 2}).value().at<float>(1, 1) == doctest::Approx(1.0F));
}

TEST_CASE("a mask of another size is an error that says both sizes") {
  const test::TemporaryFolder folder;
  cv::imwrite((folder / "m.png").string(), cv::Mat::zeros(2, 3, CV_8UC1));
  const Result<cv::Mat> mask = read_own_body_mask(folder / "m.png", {4, 4});
  REQUIRE_FALSE(mask.has_value());
  CHECK(mask.error().what.find("3x2") != std::string::npos);
  CHECK(mask.error().what.find("4x4") != std::string::npos);
}

TEST_CASE("a missing mask and a file that is not an image are errors") {
  const test::TemporaryFolder folder;
  std::ofstream(folder / "t.png") << "no image";
  CHECK(read_own_body_mask(folder / "no.png", {1, 1}).error().kind == ErrorKind::cannot_read);
  CHECK(read_own_body_mask(folder / "t.png", {1, 1}).error().kind == ErrorKind::bad_data);
}
