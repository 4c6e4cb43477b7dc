// SPDX-License-Identifier: MIT
#include "camera/calibration_text.h"

#include <doctest/doctest.h>

#include <cmath>
#include <fstream>
#include <opencv2/core/persistence.hpp>

#include "camera/camera.h"
#include "camera/example_lenses.h"
#include "support/test_data.h"

namespace sigs {
namespace {

const CalibrationText kWide{.lens = {.model = LensModel::kannala_brandt,
                                     .fx = 812.345678901234,
                                     .fy = 811.1,
                                     .cx = 639.123,
                                     .cy = 1.0 / 3,
                                     .coefficients = {0.0123, -1e-17, 0.25, -3}},
                            .size_px = {1280, 960},
                            .comment = "two -- hyphens --- and more",
                            .numbers = {{"reprojection_error_px", 0.123}, {"unknown", NAN}}};

}  // namespace

TEST_CASE("a written calibration reads back as the same numbers, by OpenCV and by our own reader") {
  const test::TemporaryFolder folder;
  for (const bool fisheye : {true, false}) {
    CalibrationText wide = kWide;
    if (!fisheye) wide.lens.model = LensModel::brown_conrady;
    const auto path = folder / (fisheye ? "fisheye.xml" : "brown.xml");
    std::ofstream(path) << calibration_xml(wide);
    const Result<Camera> camera = read_calibration(path);
    REQUIRE_MESSAGE(camera, (camera ? "" : camera.error().text()));
    CHECK(camera->lens.parameters() == wide.lens);
    CHECK(camera->size_px == wide.size_px);
    cv::FileStorage file(path.string(), cv::FileStorage::READ);
    cv::Mat matrix, coefficients;
    file["camera_matrix"] >> matrix;
    file["distortion_coefficients"] >> coefficients;
    CHECK(matrix.at<double>(0, 0) == wide.lens.fx);
    CHECK(matrix.at<double>(1, 2) == wide.lens.cy);
    CHECK(coefficients.rows == 4);
    CHECK(coefficients.at<double>(1) == -1e-17);
    CHECK(static_cast<int>(file["fisheye_model"]) == (fisheye ? 1 : 0));
    CHECK(static_cast<double>(file["reprojection_error_px"]) == 0.123);
    CHECK(file["unknown"].empty());
  }
}

TEST_CASE("a lens of any model is written so that it reads back") {
  const test::TemporaryFolder folder;
  for (const test::ExampleLens& example : test::example_lenses()) {
    const LensParameters& lens = example.lens.parameters();
    if (lens.coefficients.empty()) continue;  // the next test
    INFO(example.name);
    std::ofstream(folder / "lens.xml") << calibration_xml(
        {.lens = lens, .size_px = example.size_px, .comment = "", .numbers = {}});
    const Result<Camera> camera = read_calibration(folder / "lens.xml");
    REQUIRE(camera);
    CHECK(camera->lens.parameters() == lens);
    CHECK(camera->size_px == example.size_px);
  }
}

TEST_CASE("a lens without distortion is written so that it reads back as a pinhole") {
  const test::TemporaryFolder folder;
  CalibrationText plain = kWide;
  plain.lens.model = LensModel::brown_conrady;
  plain.lens.coefficients.clear();
  std::ofstream(folder / "plain.xml") << calibration_xml(plain);
  const Result<Camera> camera = read_calibration(folder / "plain.xml");
  REQUIRE(camera);
  CHECK(camera->lens.is_pinhole());
}

}  // namespace sigs
