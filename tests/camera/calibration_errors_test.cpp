// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <fstream>
#include <opencv2/core.hpp>
#include <optional>
#include <string>

#include "camera/camera.h"
#include "support/test_data.h"

namespace sigs::test {
namespace {

// The whole message; empty where there is none. Every message is one line and every fault of a readable file bad data.
std::string message(const std::string& text, std::optional<cv::Size> footage_px = cv::Size(640, 480)) {
  const TemporaryFolder folder;
  std::ofstream(folder / "gopro.any", std::ios::binary) << text;
  const auto camera = read_calibration(folder / "gopro.any", footage_px);
  if (camera) return "";
  CHECK(camera.error().kind == ErrorKind::bad_data);
  CHECK(camera.error().text().find('\n') == std::string::npos);
  CHECK(camera.error().text().find("gopro.any") == 0);  // the name, not the whole path
  return camera.error().text();
}

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

std::string with_matrix(const std::string& matrix) {
  return "camera_matrix: " + matrix + "\nD: [1, 2, 3, 4]\n";
}
std::string with_coefficients(const std::string& coefficients) {
  return "K: [500, 0, 320, 0, 510, 240, 0, 0, 1]\ndist_coeffs: " + coefficients + "\n";
}
std::string with(const std::string& rest) {
  return with_coefficients("[-0.1, 0.1, 0, 0]") + rest;
}

const std::string kGyroflow =
    R"("fisheye_params": {"camera_matrix": [[500, 0, 320], [0, 510, 240], [0, 0, 1]], "distortion_coeffs": [1, 2, 3, 4]})";

}  // namespace

TEST_CASE("the correct texts from which the faulty ones are derived are read") {
  CHECK(message(with_matrix("[500, 0, 320, 0, 510, 240, 0, 0, 1]")).empty());
  CHECK(message(with("")).empty());
  CHECK(message("{" + kGyroflow + "}").empty());
}

TEST_CASE("a calibration that cannot be opened gives another kind of error than a faulty one") {
  const TemporaryFolder folder;
  const auto missing = read_calibration(folder / "none.xml");
  REQUIRE_FALSE(missing.has_value());
  CHECK(missing.error().kind == ErrorKind::cannot_read);
  CHECK(contains(missing.error().text(), "none.xml: no such file"));
  const auto a_folder = read_calibration(folder.path());
  REQUIRE_FALSE(a_folder.has_value());
  CHECK(a_folder.error().kind == ErrorKind::cannot_read);
}

TEST_CASE("a file that is not a calibration is refused") {
  CHECK(message("") == "gopro.any: is empty");
  CHECK(message(" \n\t\n") == "gopro.any: is empty");
  CHECK(message(std::string("\x89PNG\0\0\x01", 7)) == "gopro.any: is not a text file");
  for (const char* text : {"hello",
                           "- 1\n- 2\n",
                           "42",
                           "<html><body>x</body></html>",
                           "<?xml version=\"1.0\"?>",
                           "<?xml version=\"1.0\"?><opencv_storage><camera_matrix>",
                           "{\"a\": [1, 2",
                           "{]",
                           "[1, 2]",
                           "%YAML:1.0",
                           "%YAML:1.0\n---\na: [1, 2\n",
                           "a: [1, 2\nb: }",
                           "K: *nowhere",
                           "<",
                           "{",
                           "%",
                           "%YAML:1.0\n---\nK: !!opencv-matrix\n   rows: 3\n",
                           "\xff\xfe<",
                           "{}",
                           "---\n---\n"})
    CHECK_MESSAGE(!message(text).empty(), text);
  CHECK(contains(message("K: 1\nD: [1, 2\n"), "line "));
  CHECK(message("{\n\"a\": 1,\n\"b\": }") == "gopro.any: line 3: not readable as JSON");
}

TEST_CASE("missing keys are named") {
  CHECK(message("D: [1, 2, 3, 4]\n") ==
        "gopro.any: no camera matrix; looked for camera_matrix, Camera_Matrix, cameraMatrix, K, k, M1");
  const std::string text = message("K: [500, 0, 320, 0, 510, 240, 0, 0, 1]\n");
  CHECK(contains(text, "gopro.any: no distortion coefficients; looked for distortion_coefficients, "));
  CHECK(contains(text, "dist_coeffs"));
  const std::string size = message(with(""), std::nullopt);
  CHECK(contains(size, "gopro.any: no image size"));
  CHECK(contains(size, "image_size"));
  CHECK(contains(size, "image_width"));
}

TEST_CASE("an invalid camera matrix is refused") {
  CHECK(message(with_matrix("[500, 0, 320, 0, 510, 240, 0, 0]")) ==
        "gopro.any: camera_matrix: expected 9 numbers, found 8");
  CHECK(message(with_matrix("[]")) == "gopro.any: camera_matrix: expected 9 numbers, found 0");
  CHECK(message(with_matrix("[500, 0, abc, 0, 510, 240, 0, 0, 1]")) ==
        "gopro.any: camera_matrix: 'abc' is not a number");
  CHECK(message(with_matrix("[500, 0, .nan, 0, 510, 240, 0, 0, 1]")) ==
        "gopro.any: camera_matrix: nan is not a finite number");
  CHECK(message(with_matrix("[.inf, 0, 320, 0, 510, 240, 0, 0, 1]")) ==
        "gopro.any: camera_matrix: inf is not a finite number");
  CHECK(message(with_matrix("[500, 0, 320, 0, -510, 240, 0, 0, 1]")) ==
        "gopro.any: camera_matrix: focal lengths must be positive, are 500 and -510");
  CHECK(message(with_matrix("[0, 0, 320, 0, 510, 240, 0, 0, 1]")) ==
        "gopro.any: camera_matrix: focal lengths must be positive, are 0 and 510");
  CHECK(message(with_matrix("[500, 0.7, 320, 0, 510, 240, 0, 0, 1]")) ==
        "gopro.any: camera_matrix: skew is not supported; the 2nd and 4th numbers must be 0, are 0.7 and 0");
  CHECK(message(with_matrix("[500, 0, 320, -0.7, 510, 240, 0, 0, 1]")) ==
        "gopro.any: camera_matrix: skew is not supported; the 2nd and 4th numbers must be 0, are 0 and -0.7");
  CHECK(message(with_matrix("[500, 4e-4, 320, 0, 510, 240, 0, 0, 1]")).empty());  // under a millionth of fx
  CHECK(message(with_matrix("[500, 0, 320, 0, 510, 240, 0, 0, 2]")) ==
        "gopro.any: camera_matrix: the last row must be 0 0 1, is 0 0 2");
  CHECK(message(with_matrix("{rows: 3, cols: 3, data: [500, 0, 320]}")) ==
        "gopro.any: camera_matrix: rows and cols say 9 numbers, found 3");
}

TEST_CASE("an invalid camera matrix of OpenCV is refused") {
  const auto xml = [](const std::string& data) {
    return "<?xml version=\"1.0\"?><opencv_storage><camera_matrix "
           "type_id=\"opencv-matrix\"><rows>3</rows><cols>3</cols>"
           "<dt>d</dt><data>" +
           data + "</data></camera_matrix><D>1 2 3 4</D></opencv_storage>";
  };
  CHECK(message(xml("500. 0. 320. 0. 510. 240. 0. 0. 1.")).empty());
  CHECK(message(xml("500. 0. 320. 0. 510. 240. 0. 0.")) ==
        "gopro.any: camera_matrix: rows and cols say 9 numbers, found 8");
  CHECK(message(xml("500. 0. .Nan 0. 510. 240. 0. 0. 1.")) == "gopro.any: camera_matrix: nan is not a finite number");
  CHECK(message(xml("500. 0. -.Inf 0. 510. 240. 0. 0. 1.")) == "gopro.any: camera_matrix: -inf is not a finite number");
  CHECK(message(xml("500. 0. left 0. 510. 240. 0. 0. 1.")) == "gopro.any: camera_matrix: 'left' is not a number");
}

TEST_CASE("coefficients that fit no model are refused") {
  CHECK(message(with_coefficients("[1, 2, 3, 4, 5, 6]")) ==
        "gopro.any: dist_coeffs: expected 0, 4, 5, 8, 12 or 14 distortion coefficients, found 6");
  CHECK(message(with_coefficients("[1, 2, 3, 4, 5]\nfisheye_model: 1")) ==
        "gopro.any: dist_coeffs: expected 4 fisheye coefficients, found 5");
  CHECK(message(with_coefficients("[1, 2, 3, x]")) == "gopro.any: dist_coeffs: 'x' is not a number");
  CHECK(message(with_coefficients("[1, 2, 3, .inf]")) == "gopro.any: dist_coeffs: inf is not a finite number");
  CHECK(message(with_coefficients("{rows: 1, cols: 5, data: [1, 2, 3, 4]}")) ==
        "gopro.any: dist_coeffs: rows and cols say 5 numbers, found 4");
  CHECK(
      contains(message(with_coefficients("[0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 2]")), "dist_coeffs: the sensor's"));
}

TEST_CASE("an invalid size is refused") {
  CHECK(message(with("image_width: 640")) ==
        "gopro.any: image_width: a width without a height; looked for image_height, image_Height, imageHeight, height");
  CHECK(contains(message(with("height: 480")), "gopro.any: height: a height without a width"));
  for (const char* width : {"0", "-640", "640.5", "1e9", ".nan", ".inf"})
    CHECK(contains(message(with("image_height: 480\nimage_width: " + std::string(width))),
                   "gopro.any: image_width: expected a whole number of pixels, found "));
  for (const char* width : {"wide", "[1, 2]", "[]", "~"})
    CHECK(message(with("image_height: 480\nimage_width: " + std::string(width))) ==
          "gopro.any: image_width: expected one number");
  for (const char* size : {"640", "[640]", "[640, 480, 3]", "640x480"})
    CHECK(message(with("image_size: " + std::string(size))) ==
          "gopro.any: image_size: expected 2 numbers, width and height");
}

TEST_CASE("a calibration of another aspect ratio is refused with both sizes") {
  CHECK(message(with("image_size: [640, 480]"), cv::Size(1280, 720)) ==
        "gopro.any: made for 640x480, which is not the shape of the footage, 1280x720");
  CHECK(contains(message(with("image_size: [640, 480]"), cv::Size(480, 640)), "480x640"));
  CHECK(message(with("image_size: [640, 480]"), cv::Size(0, 0)) == "gopro.any: cannot be scaled to footage of 0x0");
}

TEST_CASE("footage without a size is refused for a file without one") {
  CHECK(message(with(""), cv::Size(0, 0)) == "gopro.any: cannot be scaled to footage of 0x0");
}

TEST_CASE("unsupported models are refused by name") {
  CHECK(message(with("distortion_model: fov")) ==
        "gopro.any: distortion_model: distortion model 'fov' is not supported; known are plumb_bob, "
        "equidistant, omnidirectional, double_sphere, extended_unified, equirectangular");
  CHECK(message(with("fisheye_model: perhaps")) == "gopro.any: fisheye_model: expected 0 or 1");
}

TEST_CASE("faulty parameters of models that look at a sphere are refused by name") {
  CHECK(message(with("xi: 0.95")).empty());
  CHECK(message(with("xi: [0.95, 1]")) == "gopro.any: xi: expected one number");
  CHECK(message(with("xi: wide")) == "gopro.any: xi: 'wide' is not a number");
  CHECK(message(with_coefficients("[1, 2, 3, 4, 5]") + "xi: 0.95") ==
        "gopro.any: dist_coeffs: expected 4 coefficients k1 k2 p1 p2 beside xi, found 5");
  const TemporaryFolder folder;
  const auto warnings_of = [&](const std::string& text) {
    std::ofstream(folder / "both.yaml") << text;
    const auto camera = read_calibration(folder / "both.yaml", cv::Size(640, 480));
    REQUIRE(camera);
    return camera->warnings;
  };
  CHECK(warnings_of(with("xi: 0.95\ndistortion_model: plumb_bob")).empty());  // what xi's plane is distorted by
  for (const char* const other : {"xi: 0.95\nfisheye_model: 1", "xi: 0.95\ndistortion_model: equidistant"}) {
    const std::vector<Warning> warnings = warnings_of(with(other));
    REQUIRE(warnings.size() == 1);
    CHECK(warnings[0].text() == "both.yaml: xi: makes the model omnidirectional, though the file names fisheye too");
  }
  std::ofstream(folder / "sphere.yaml") << "K: [500, 0, 320, 0, 510, 240, 0, 0, 1]\ndistortion_model: ds\nD: [0, 0.5]";
  const auto as_fisheye = read_calibration(folder / "sphere.yaml", cv::Size(640, 480), LensModel::kannala_brandt);
  REQUIRE_FALSE(as_fisheye);
  CHECK(as_fisheye.error().text() ==
        "sphere.yaml: D: expected 4 fisheye coefficients, found 2; the file says double_sphere");
  CHECK(message(with("xi: -0.1")) == "gopro.any: dist_coeffs: xi, the first coefficient, must be at least 0");
  const std::string two = "K: [500, 0, 320, 0, 510, 240, 0, 0, 1]\n";
  CHECK(message(two + "distortion_model: double_sphere\nD: [1, 0.5]") ==
        "gopro.any: D: xi, the first coefficient, must lie between -1 and 1");
  CHECK(message(two + "distortion_model: double_sphere\nD: [0.5, 1.5]") ==
        "gopro.any: D: alpha, the second coefficient, must be 0 to 1");
  CHECK(message(two + "distortion_model: eucm\nD: [0.5, 0]") ==
        "gopro.any: D: beta, the second coefficient, must be positive");
  CHECK(message(two + "distortion_model: eucm\nD: [0.5, 1, 2]") ==
        "gopro.any: D: expected 2 extended unified coefficients, found 3");
}

TEST_CASE("Gyroflow profiles that are not plain fisheye lenses are refused by name") {
  CHECK(message("{" + kGyroflow + ", \"distortion_model\": \"poly5\"}") ==
        "gopro.any: distortion_model: Gyroflow's model \"poly5\" is not supported; opencv_fisheye is");
  CHECK(message("{" + kGyroflow + ", \"digital_lens\": \"gopro_superview\"}") ==
        "gopro.any: digital_lens: the digital lens \"gopro_superview\" is not supported");
  CHECK(message("{" + kGyroflow + ", \"input_horizontal_stretch\": 133}") ==
        "gopro.any: input_horizontal_stretch: expected a number from 0.1 to 10, found 133");
  CHECK(message(R"({"fisheye_params": {"distortion_coeffs": [1, 2, 3, 4]}})") ==
        "gopro.any: fisheye_params.camera_matrix: missing");
  CHECK(message(R"({"fisheye_params": null})") == "gopro.any: fisheye_params.camera_matrix: missing");
  CHECK(message("{" + kGyroflow + R"(, "calib_dimension": {"w": 640}})") ==
        "gopro.any: calib_dimension: expected 2 numbers, width and height");
  std::string three = "{" + kGyroflow + "}";
  three.replace(three.find("[1, 2, 3, 4]"), 12, "[1, 2, \"x\"]");
  CHECK(message(three) == "gopro.any: fisheye_params.distortion_coeffs: '\"x\"' is not a number");
}

}  // namespace sigs::test
