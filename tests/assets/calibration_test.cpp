// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <opencv2/core/persistence.hpp>

#include "support/test_data.h"

namespace sigs::test {

namespace {

struct Numbers {
  int width = 0, height = 0, fisheye = 0;
  cv::Mat matrix, k;
};

Numbers sample_lens() {
  const cv::FileStorage file((source_dir() / "assets/calibrations/sample.xml").string(), cv::FileStorage::READ);
  Numbers lens;
  file["image_width"] >> lens.width;
  file["image_height"] >> lens.height;
  file["fisheye_model"] >> lens.fisheye;
  file["camera_matrix"] >> lens.matrix;
  file["distortion_coefficients"] >> lens.k;
  return lens;
}

// Kannala and Brandt (2006), as OpenCV's fisheye module has it: radius over focal length at an angle from the axis.
double radius(const cv::Mat& k, double angle) {
  const double a2 = angle * angle;
  const double* c = k.ptr<double>();
  return angle * (1 + a2 * (c[0] + a2 * (c[1] + a2 * (c[2] + a2 * c[3]))));
}

}  // namespace

TEST_CASE("the sample calibration is a fisheye lens for the sample clip") {
  const Numbers lens = sample_lens();
  CHECK(lens.width == 1280);
  CHECK(lens.height == 960);
  CHECK(lens.fisheye == 1);
  REQUIRE(lens.matrix.size() == cv::Size(3, 3));
  REQUIRE(lens.k.total() == 4);
  CHECK(lens.matrix.at<double>(0, 0) == doctest::Approx(lens.matrix.at<double>(1, 1)).epsilon(0.01));  // square pixels
}

TEST_CASE("the sample lens is one to one over the whole image and wider than 110 degrees") {
  const Numbers lens = sample_lens();
  REQUIRE(lens.k.total() == 4);
  const double focal_px = lens.matrix.at<double>(0, 0);
  const double corner = std::hypot(lens.matrix.at<double>(0, 2) + 0.5, lens.matrix.at<double>(1, 2) + 0.5) / focal_px;
  const double side = (lens.matrix.at<double>(0, 2) + 0.5) / focal_px;
  double angle = 0, side_angle = 0;
  constexpr double kStep = 1e-4;
  for (; radius(lens.k, angle) < corner * 1.02; angle += kStep) {
    REQUIRE(radius(lens.k, angle + kStep) > radius(lens.k, angle));
    if (radius(lens.k, angle) < side) side_angle = angle;
  }
  CHECK(angle < std::numbers::pi / 2);  // every pixel's ray points forward
  CHECK(2 * side_angle * 180 / std::numbers::pi > 110);
}

}  // namespace sigs::test
