// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <opencv2/calib3d.hpp>
#include <opencv2/core.hpp>
#include <opencv2/core/persistence.hpp>
#include <optional>
#include <string>
#include <vector>

#include "camera/camera.h"
#include "support/test_data.h"

namespace sigs::test {
namespace {

using Coefficients = std::vector<double>;

Result<Camera> read(const std::string& text, std::optional<cv::Size> footage_px = std::nullopt,
                    const std::string& name = "camera.any") {
  const TemporaryFolder folder;
  std::ofstream(folder / name, std::ios::binary) << text;
  return read_calibration(folder / name, footage_px);
}

// fx 500, fy 510, cx 320, cy 240 and the given coefficients, whatever the format.
void check_reads_as(const std::string& text, LensModel model, const Coefficients& coefficients,
                    cv::Size size_px = {640, 480}) {
  INFO(text);
  const auto camera = read(text);
  if (!camera) FAIL_CHECK(camera.error().text());
  if (!camera) return;
  const LensParameters& lens = camera->lens.parameters();
  CHECK(lens.model == model);
  CHECK(lens.fx == 500);
  CHECK(lens.fy == 510);
  CHECK(lens.cx == 320);
  CHECK(lens.cy == 240);
  CHECK(lens.coefficients == coefficients);
  CHECK(camera->size_px == size_px);
}

constexpr auto kBrown = LensModel::brown_conrady;
constexpr auto kFisheye = LensModel::kannala_brandt;
const std::string kMatrixYaml = "[500, 0, 320, 0, 510, 240, 0, 0, 1]";
const std::string kMatrixXml =
    " type_id=\"opencv-matrix\"><rows>3</rows><cols>3</cols><dt>d</dt>\n"
    "<data>500. 0. 320. 0. 5.1e2 240. 0. 0. 1.</data></";

std::string xml(const std::string& matrix_key, const std::string& coefficient_key, const std::string& rest) {
  return "<?xml version=\"1.0\"?>\n<opencv_storage>\n<" + matrix_key + kMatrixXml + matrix_key + ">\n<" +
         coefficient_key +
         " type_id=\"opencv-matrix\"><rows>1</rows><cols>4</cols><dt>d</dt><data>-0.25 0.125 0. 0.5e-3</data></" +
         coefficient_key + ">\n" + rest + "</opencv_storage>\n";
}

const std::string kSizeXml = "<image_width>640</image_width><image_height>480</image_height>";

}  // namespace

TEST_CASE("files that OpenCV has written are read back") {
  const cv::Mat matrix = (cv::Mat_<double>(3, 3) << 500, 0, 320, 0, 510, 240, 0, 0, 1);
  const Coefficients coefficients{-0.25, 0.125, 0.001, -0.002, 1.0 / 3};
  for (const char* extension : {".xml", ".yml", ".json"})
    for (const bool base64 : {false, true}) {
      cv::FileStorage out(extension,
                          cv::FileStorage::WRITE | cv::FileStorage::MEMORY | (base64 ? cv::FileStorage::BASE64 : 0));
      out << "calibration_time"
          << "Tue 07 Aug 2018"
          << "image_width" << 640 << "image_height" << 480;
      out << "flags" << 6158 << "fisheye_model" << 0 << "camera_matrix" << matrix;
      out << "distortion_coefficients" << cv::Mat(coefficients) << "rms" << 0.39;
      if (base64 && std::string(extension) == ".json")
        continue;  // OpenCV's own reader supports it, the JSON reader does not
      check_reads_as(out.releaseAndGetString(), kBrown, coefficients);
    }
}

TEST_CASE("an empty list of coefficients is a pinhole") {
  check_reads_as("K: " + kMatrixYaml + "\nD: []\nwidth: 640\nheight: 480\n", kBrown, {});
}

TEST_CASE("all names of matrix and coefficients are known in XML") {
  for (const char* matrix : {"camera_matrix", "Camera_Matrix", "cameraMatrix", "K", "M1"})
    for (const char* coefficients : {"distortion_coefficients", "Distortion_Coefficients", "dist_coeffs", "dist_coefs",
                                     "dist_coeff", "distCoeffs", "D", "D1"})
      check_reads_as(xml(matrix, coefficients, kSizeXml), kBrown, {-0.25, 0.125, 0, 0.5e-3});
}

TEST_CASE("all ways to state the size are known") {
  const Coefficients four{-0.25, 0.125, 0, 0.5e-3};
  for (const char* size : {
           "<image_Width>640</image_Width><image_Height>480</image_Height>",
           "<imageWidth>640</imageWidth><imageHeight>480</imageHeight>",
           "<width>640</width><height>480</height>",
           "<image_size>640 480</image_size>",
           "<imageSize>\n  640 480</imageSize>",
           "<image_Size>640. 480.</image_Size>",
       })
    check_reads_as(xml("camera_matrix", "D", size), kBrown, four);
}

TEST_CASE("the fisheye flag chooses the model") {
  const Coefficients four{-0.25, 0.125, 0, 0.5e-3};
  check_reads_as(xml("K", "D", kSizeXml + "<fisheye_model>1</fisheye_model>"), kFisheye, four);
  check_reads_as(xml("K", "D", kSizeXml + "<fisheye_model>0</fisheye_model>"), kBrown, four);
  const std::string yaml = "K: " + kMatrixYaml + "\nD: [1, 2, 3, 4]\nimage_size: [640, 480]\nfisheye: ";
  check_reads_as(yaml + "true\n", kFisheye, {1, 2, 3, 4});
  check_reads_as(yaml + "false\n", kBrown, {1, 2, 3, 4});
}

TEST_CASE("YAML of ROS and of scripts is read") {
  const std::string head = "image_width: 640\nimage_height: 480\ncamera_name: nose\n";
  const std::string matrix = "camera_matrix:\n  rows: 3\n  cols: 3\n  data: " + kMatrixYaml + "\n";
  const std::string five = "distortion_coefficients:\n  rows: 1\n  cols: 5\n  data: [-0.25, 0.125, 0, 0, 1e-3]\n";
  const std::string four = "distortion_coefficients:\n  rows: 1\n  cols: 4\n  data: [-0.25, 0.125, 0, 0]\n";
  const std::string eight =
      "distortion_coefficients:\n  rows: 1\n  cols: 8\n  data: [1, 2, 3, 4, 5, 6, 7, 8]\n"
      "rectification_matrix:\n  rows: 3\n  cols: 3\n  data: [1, 0, 0, 0, 1, 0, 0, 0, 1]\n";
  check_reads_as(head + matrix + "distortion_model: plumb_bob\n" + five, kBrown, {-0.25, 0.125, 0, 0, 1e-3});
  check_reads_as(head + matrix + "distortion_model: rational_polynomial\n" + eight, kBrown, {1, 2, 3, 4, 5, 6, 7, 8});
  check_reads_as(head + matrix + "distortion_model: equidistant\n" + four, kFisheye, {-0.25, 0.125, 0, 0});
  check_reads_as(head + matrix + "distortion_model: fisheye\n" + four, kFisheye, {-0.25, 0.125, 0, 0});
  check_reads_as("height: 480\nwidth: 640\ndistortion_model: plumb_bob\nd: [-0.25, 0.125, 0, 0]\nk: " + kMatrixYaml,
                 kBrown, {-0.25, 0.125, 0, 0});
  check_reads_as("%YAML 1.2\n---\n" + head + "camera_matrix:\n- [500.0, 0.0, 320.0]\n- [0.0, 510.0, 240.0]\n" +
                     "- [0.0, 0.0, 1.0]\ndist_coefs:\n- [-0.25, 0.125, 0, 0,\n  1e-3]\n",
                 kBrown, {-0.25, 0.125, 0, 0, 1e-3});
}

TEST_CASE("YAML with OpenCV tags is read with its own header and without") {
  const std::string body =
      "image_width: 640\nimage_height: 480\n"
      "camera_matrix: !!opencv-matrix\n   rows: 3\n   cols: 3\n   dt: d\n   data: [ 500., 0., 320., 0.,\n"
      "       5.1e+02, 240., 0., 0., 1. ]\n"
      "distortion_coefficients: !!opencv-matrix\n   rows: 4\n   cols: 1\n   dt: d\n   data: [ -0.25, 0.125, 0., .05 "
      "]\n";
  for (const char* head : {"%YAML:1.0\n---\n", "%YAML:1.0\n", "", "---\n", "\xEF\xBB\xBF", "\n\n  \n"})
    check_reads_as(head + body, kBrown, {-0.25, 0.125, 0, 0.05});
}

TEST_CASE("line ends of Windows are accepted") {
  std::string text = "%YAML:1.0\n---\nK: " + kMatrixYaml + "\nD: [1, 2, .03, .04]\nimage_size: [640, 480]\n";
  for (std::size_t at = 0; (at = text.find('\n', at)) != std::string::npos; at += 2) text.replace(at, 1, "\r\n");
  check_reads_as(text, kBrown, {1, 2, 0.03, 0.04});
  check_reads_as(text.substr(16), kBrown, {1, 2, 0.03, 0.04});
}

TEST_CASE("plain JSON is read by the same names") {
  check_reads_as(
      "{\n\t\"camera_matrix\": [[500, 0, 320], [0, 510, 240], [0, 0, 1]],\n\t\"dist_coeff\": [[1, 2, 0.03, 0.04]],\n"
      "\t\"image_size\": [640, 480], \"note\": null}",
      kBrown, {1, 2, 0.03, 0.04});
}

TEST_CASE("a Gyroflow lens profile is a fisheye") {
  const std::string head = R"({"name": "x", "calib_dimension": {"w": 640, "h": 480}, "orig_dimension": {"w": 9, "h": 9},
    "fisheye_params": {"camera_matrix": [[500, 0, 320], [0, 510, 240], [0, 0, 1]], "distortion_coeffs": [1, 2, 3, 4]})";
  for (const char* rest : {"}", ", \"distortion_model\": null}", ", \"distortion_model\": \"opencv_fisheye\"}",
                           ", \"digital_lens\": null, \"input_horizontal_stretch\": 1.0}"})
    check_reads_as(head + rest, kFisheye, {1, 2, 3, 4});
}

namespace {

std::string profile(const std::string& rest, const std::string& size = R"({"w": 640, "h": 480})") {
  return R"({"calib_dimension": )" + size + R"(,
    "fisheye_params": {"camera_matrix": [[500, 0, 320], [0, 510, 240], [0, 0, 1]], "distortion_coeffs": [0, 0, 0, 0]})" +
         rest + "}";
}

}  // namespace

TEST_CASE("a Gyroflow profile's stabilisation crop keeps the middle of the image and enlarges it") {
  const auto whole = read(profile(R"(, "crop": null)"));
  const auto cropped = read(profile(R"(, "crop": 0.8)"));
  REQUIRE(whole.has_value());
  REQUIRE(cropped.has_value());
  const glm::dvec2 middle(319.5, 239.5);  // of 640x480 pixels
  for (const glm::dvec3& at : {glm::dvec3{1, 0, 0}, glm::dvec3{1, 0.2, -0.1}, glm::dvec3{1, -0.3, 0.2}})
    CHECK(glm::distance(*cropped->lens.pixel(at), middle + (*whole->lens.pixel(at) - middle) / 0.8) < 1e-10);
  for (const char* wrong : {"0", "-1", "1e9", "\"0.9\"", "[1]"})
    CHECK_FALSE(read(profile(std::string(R"(, "crop": )") + wrong)).has_value());
}

TEST_CASE("a Gyroflow profile's stretch applies to its images and not to the footage's") {
  // Of real footage of 3840x2160 with a 1.212 anamorphic lens: 3840 * 1.212 = 4654.
  const std::string text = profile(R"(, "input_horizontal_stretch": 1.212)", R"({"w": 4654, "h": 2160})");
  const auto own = read(text);
  const auto half = read(text, cv::Size(1920, 1080));
  REQUIRE(own.has_value());
  REQUIRE(half.has_value());
  CHECK(own->size_px == cv::Size(3840, 2160));
  CHECK(own->lens.parameters().fx == doctest::Approx(500 * 3840.0 / 4654).epsilon(1e-15));
  CHECK(own->lens.parameters().fy == 510);
  CHECK(half->lens.parameters().fx == doctest::Approx(250 * 3840.0 / 4654).epsilon(1e-15));
  CHECK_FALSE(read(text, cv::Size(4654, 2160)).has_value());
  const auto high = read(profile(R"(, "input_vertical_stretch": 1.5)", R"({"w": 640, "h": 720})"));
  REQUIRE(high.has_value());
  CHECK(high->size_px == cv::Size(640, 480));
  CHECK(high->lens.parameters().fy == doctest::Approx(340).epsilon(1e-15));
  CHECK(read(profile(R"(, "input_horizontal_stretch": 0.0)"))->lens.parameters().fx == 500);  // not set
}

TEST_CASE("a warning names each setting that a Gyroflow profile leaves open") {
  const TemporaryFolder folder;
  const auto warnings = [&](const std::string& rest) {
    std::ofstream(folder / "p.json") << profile(rest);
    const auto file = read_calibration(folder / "p.json");
    REQUIRE(file.has_value());
    return file->warnings;
  };
  const std::string settings = R"(, "compatible_settings": [{"width": 640, "height": 480},
    {"width": 640, "height": 480, "crop": 0.928}, {"width": 640, "crop": 0.745}, {"crop": 0.928}])";
  REQUIRE(warnings(settings).size() == 1);
  CHECK(warnings(settings)[0].text().find("p.json: compatible_settings") == 0);
  CHECK(warnings(settings)[0].what.find("0.745, 0.928") != std::string::npos);
  CHECK(warnings(settings + R"(, "crop": 0.928)")[0].what.find("0.928 too") == std::string::npos);
  CHECK(warnings(R"(, "interpolations": {"10": {}})").size() == 1);
  CHECK(warnings(R"(, "compatible_settings": [], "interpolations": null, "crop": null)").empty());
}

TEST_CASE("the first camera of a stereo pair is read") {
  check_reads_as("K: " + kMatrixYaml + "\nM2: [1]\nD: [1, 2, .03, .04]\nD2: [7]\nimage_size: [640, 480]\n", kBrown,
                 {1, 2, 0.03, 0.04});
}

TEST_CASE("a calibration without a size is made for the footage") {
  const std::string text = "K: " + kMatrixYaml + "\nD: [1, 2, 3, 4]\n";
  const auto camera = read(text, cv::Size(1234, 777));
  REQUIRE(camera.has_value());
  CHECK(camera->size_px == cv::Size(1234, 777));
  CHECK(camera->lens.parameters().fx == 500);
  CHECK(camera->lens.parameters().cy == 240);
}

TEST_CASE("a calibration is scaled to footage of the same aspect ratio") {
  const std::string text = "K: " + kMatrixYaml + "\nD: [-0.2, 0.1, 0, 0]\nimage_size: [640, 480]\n";
  const auto own = read(text);
  const auto same = read(text, cv::Size(640, 480));
  const auto doubled = read(text, cv::Size(1280, 960));
  REQUIRE(own.has_value());
  REQUIRE(same.has_value());
  REQUIRE(doubled.has_value());
  CHECK(same->lens.parameters().cx == 320);
  CHECK(doubled->size_px == cv::Size(1280, 960));
  // The image's edges and middle stay where they are: -0.5 is the left edge at any size.
  for (const glm::dvec3& at : {glm::dvec3{1, 0, 0}, glm::dvec3{1, 0.3, -0.2}, glm::dvec3{1, -0.4, 0.3}}) {
    const glm::dvec2 small = *own->lens.pixel(at);
    const glm::dvec2 large = *doubled->lens.pixel(at);
    CHECK(glm::distance(large + 0.5, 2.0 * (small + 0.5)) < 1e-10);  // rounding
  }
}

TEST_CASE("a side may be rounded by half a pixel") {
  const std::string text = "K: " + kMatrixYaml + "\nD: []\nimage_size: [1920, 1080]\n";
  CHECK(read(text, cv::Size(854, 480)).has_value());  // 854 / 1920 * 1080 = 480.4
  CHECK(read(text, cv::Size(640, 360)).has_value());
  CHECK(read(text, cv::Size(3840, 2160)).has_value());
  const auto camera = read(text, cv::Size(854, 480));
  CHECK(camera->lens.parameters().fx == doctest::Approx(500 * 854.0 / 1920).epsilon(1e-15));
  CHECK(camera->lens.parameters().fy == doctest::Approx(510 * 480.0 / 1080).epsilon(1e-15));
}

TEST_CASE("a shape within one percent of the calibration's is scaled each side by itself, with a warning") {
  // GoPro's 848x480 is 853.3x480 in whole blocks of 16.
  const TemporaryFolder folder;
  std::ofstream(folder / "lens.yml") << "K: " << kMatrixYaml << "\nD: []\nimage_size: [1920, 1080]\n";
  const auto file = read_calibration(folder / "lens.yml", cv::Size(848, 480));
  REQUIRE(file.has_value());
  const LensParameters& lens = file->lens.parameters();
  CHECK(lens.fx == doctest::Approx(500 * 848.0 / 1920).epsilon(1e-15));
  CHECK(lens.fy == doctest::Approx(510 * 480.0 / 1080).epsilon(1e-15));
  CHECK(lens.cx == doctest::Approx(320.5 * 848.0 / 1920 - 0.5).epsilon(1e-15));
  CHECK(lens.cy == doctest::Approx(240.5 * 480.0 / 1080 - 0.5).epsilon(1e-15));
  REQUIRE(file->warnings.size() == 1);
  const std::string warning = file->warnings[0].text();
  CAPTURE(warning);
  for (const char* part : {"lens.yml", "1920x1080", "848x480", "0.44167", "0.44444", "2.7 px"})  // (853.3 - 848) / 2
    CHECK(warning.find(part) != std::string::npos);
  for (const cv::Size size : {cv::Size(1920, 1080), cv::Size(1280, 720), cv::Size(854, 480)})
    CHECK(read_calibration(folder / "lens.yml", size)->warnings.empty());
  for (const cv::Size size : {cv::Size(856, 480), cv::Size(1920, 1088), cv::Size(1904, 1080)})
    CHECK(read_calibration(folder / "lens.yml", size)->warnings.size() == 1);
  for (const cv::Size size : {cv::Size(864, 480), cv::Size(840, 480), cv::Size(1920, 1100), cv::Size(1440, 1080)})
    CHECK_FALSE(read_calibration(folder / "lens.yml", size).has_value());
}

TEST_CASE("a calibration of a whole image has its principal point moved to the part that is left of it") {
  const TemporaryFolder folder;
  const auto read_part = [&](const std::string& size, cv::Size part_px, const ImagePart& part) {
    std::ofstream(folder / "lens.yml") << "K: " << kMatrixYaml << "\nD: []\n" << size;
    return read_calibration(folder / "lens.yml", part_px, {}, part);
  };
  const std::string stated = "image_size: [640, 480]\n";
  const cv::Size quarter(320, 240);  // of the same shape as the whole, which is why the size has to decide
  const ImagePart of_640{{640, 480}, {160, 100}};

  // The same ray meets the whole image where the corner and the part's pixel add up to.
  const auto moved = read_part(stated, quarter, of_640);
  REQUIRE(moved.has_value());
  CHECK(moved->size_px == quarter);
  CHECK(moved->lens.parameters().fx == 500);
  const auto whole = read_calibration(folder / "lens.yml");
  for (const glm::dvec3& ray : {glm::dvec3{1, 0, 0}, glm::dvec3{1, 0.1, -0.2}})
    CHECK(glm::distance(*moved->lens.pixel(ray) + glm::dvec2(160, 100), *whole->lens.pixel(ray)) < 1e-10);
  REQUIRE(moved->warnings.size() == 1);
  CHECK(moved->warnings[0].what.find("made for the whole footage, 640x480") != std::string::npos);

  // At twice the size: half-pixel edges count.
  const auto doubled = read_part(stated, {640, 960}, {{1280, 960}, {640, 0}});
  REQUIRE(doubled.has_value());
  CHECK(doubled->lens.parameters().fx == 1000);
  CHECK(doubled->lens.parameters().cx == doctest::Approx(640.5 - 640).epsilon(1e-15));
  CHECK(doubled->lens.parameters().cy == doctest::Approx(480.5).epsilon(1e-15));

  // Made for the part, by size, by shape or without a size.
  CHECK(read_part(stated, {640, 480}, {{1280, 480}, {640, 0}})->lens.parameters().cx == 320);
  CHECK(read_part(stated, {1280, 960}, {{2560, 960}, {1280, 0}})->lens.parameters().cx == 640.5);
  CHECK(read_part(stated, {640, 480}, {{1280, 960}, {640, 0}})->warnings.empty());
  CHECK(read_part("", {640, 480}, {{1280, 960}, {640, 0}})->lens.parameters().cx == 320);

  const auto either = read_part(stated, {160, 120}, {{320, 240}, {0, 0}});
  REQUIRE_FALSE(either.has_value());
  for (const char* const size : {"640x480", "320x240", "160x120"})
    CHECK(either.error().what.find(size) != std::string::npos);
  CHECK_FALSE(read_part(stated, {100, 300}, {{200, 300}, {0, 0}}).has_value());  // of neither shape
}

TEST_CASE("all real calibrations are read") {
  if (!has_real_data()) return;
  struct Expected {
    const char* name;
    LensModel model;
    std::size_t coefficients;
    double fx;
    cv::Size size_px;  // empty: the file states none
  };
  for (const Expected& expected : {
           Expected{"ar_drone_RIGHTBLACKBOX_oldkeys.xml", kBrown, 5, 870.30170819798286, {640, 480}},
           Expected{"gopro_hero3plus_fisheye4_1280x960_derived.xml", kFisheye, 4, 558.3350517012582, {1280, 960}},
           Expected{"gyroflow_gopro_hero3plus_1440_4by3_fisheye4.json", kFisheye, 4, 837.5025775518873, {1920, 1440}},
           Expected{"hpfily_out_camera_data_oldkeys.xml", kBrown, 5, 632.56509667425644, {640, 480}},
           Expected{"ntu_mecatron_out_camera_data.xml", kBrown, 5, 560.83562584146046, {640, 480}},
           Expected{"opencv_doc_left_intrinsics.yml", kBrown, 5, 535.91573396163199, {640, 480}},
           Expected{"opencv_doc_stereo_intrinsics_M1D1.yml", kBrown, 5, 534.80326845051309, {}},
           Expected{"opencv_doc_tutorial_camera_params.yml", kBrown, 5, 628.158, {}},
           Expected{"opencv_left_plus_12coef_derived.yml", kBrown, 12, 535.91573396163199, {640, 480}},
           Expected{"opencv_left_plus_14coef_derived.yml", kBrown, 14, 535.91573396163199, {640, 480}},
           Expected{"rational8_oakd_250_derived.yml", kBrown, 8, 202.61964416503906, {250, 250}},
           Expected{"ros_camera_info_plumb_bob.yaml", kBrown, 5, 1168.68, {640, 480}},
           Expected{"uav_skyeye_out_camera_data.xml", kBrown, 5, 233.64878280783012, {640, 480}},
           Expected{"video2calibration_gopro_plain.yaml", kBrown, 5, 774.5585769798772, {}},
       }) {
    INFO(expected.name);
    const auto path = real_data() / "calibrations" / expected.name;
    const auto alone = read_calibration(path);
    CHECK(alone.has_value() == !expected.size_px.empty());
    const cv::Size footage_px = expected.size_px.empty() ? cv::Size(1280, 720) : expected.size_px;
    const auto camera = read_calibration(path, footage_px);
    REQUIRE(camera.has_value());
    CHECK(camera->lens.parameters().model == expected.model);
    CHECK(camera->lens.parameters().coefficients.size() == expected.coefficients);
    CHECK(camera->lens.parameters().fx == expected.fx);
    CHECK(camera->size_px == footage_px);
  }
}

TEST_CASE("a real Gyroflow profile and the same lens in XML agree once scaled") {
  if (!has_real_data()) return;
  const auto folder = real_data() / "calibrations";
  const auto a = read_calibration(folder / "gyroflow_gopro_hero3plus_1440_4by3_fisheye4.json", cv::Size(1280, 960));
  const auto b = read_calibration(folder / "gopro_hero3plus_fisheye4_1280x960_derived.xml");
  REQUIRE(a.has_value());
  REQUIRE(b.has_value());
  // The XML's principal point was scaled without the half pixel, which is 0.5 - 0.5 * 2/3 = 1/6 px.
  for (const glm::dvec3& at : {glm::dvec3{1, 0, 0}, glm::dvec3{1, 0.5, 0.3}, glm::dvec3{1, -1, 0.8}})
    CHECK(glm::distance(*a->lens.pixel(at), *b->lens.pixel(at) - 1.0 / 6) < 1e-6);  // digits of the XML
}

TEST_CASE("models that look at a sphere are stated by name, or by xi") {
  const std::string matrix = "K: " + kMatrixYaml + "\nwidth: 640\nheight: 480\n";
  check_reads_as(matrix + "distortion_model: omnidirectional\nD: [0.9, -0.1, 0.02, 0, 0.001]\n",
                 LensModel::omnidirectional, {0.9, -0.1, 0.02, 0, 0.001});
  check_reads_as(matrix + "xi: 0.9\nD: [-0.1, 0.02, 0, 0.001]\n", LensModel::omnidirectional,
                 {0.9, -0.1, 0.02, 0, 0.001});
  check_reads_as("K: [500, 2, 320, 0, 510, 240, 0, 0, 1]\nwidth: 640\nheight: 480\nxi: 0.9\nD: [0, 0, 0, 0]\n",
                 LensModel::omnidirectional, {0.9, 0, 0, 0, 0, 0.004});  // skew of 2 px
  check_reads_as(matrix + "distortion_model: double_sphere\nD: [-0.2, 0.6]\n", LensModel::double_sphere, {-0.2, 0.6});
  check_reads_as(matrix + "distortion_model: eucm\nD: [0.6, 1.1]\n", LensModel::extended_unified, {0.6, 1.1});
}

// OpenCV's file holds the corners that it saw, the poses that it found, and the root mean square of what was left. The
// board's squares are 17.5 mm wide: with no other width do the poses lead back to the corners.
TEST_CASE("a real omnidirectional calibration leads from its board's poses to the corners it was made of") {
  if (!has_real_data()) return;
  const std::filesystem::path path = real_data() / "calibrations/scanvan_out_camera_omni.xml";
  const Result<Camera> camera = read_calibration(path);
  REQUIRE(camera);
  CHECK(camera->size_px == cv::Size(3008, 3008));
  cv::FileStorage file(path.string(), cv::FileStorage::READ);
  cv::Mat poses, corners;
  file["extrinsic_parameters"] >> poses;
  file["image_points"] >> corners;
  REQUIRE(poses.rows == 20);
  REQUIRE(corners.cols == 54);
  constexpr int kColumns = 9;
  constexpr double kSquare = 17.5;
  double sum_px2 = 0;
  for (int view = 0; view < poses.rows; ++view) {
    const cv::Vec3d turn(poses.at<double>(view, 0), poses.at<double>(view, 1), poses.at<double>(view, 2));
    const cv::Vec3d shift(poses.at<double>(view, 3), poses.at<double>(view, 4), poses.at<double>(view, 5));
    cv::Matx33d rotation;
    cv::Rodrigues(turn, rotation);
    for (int i = 0; i < corners.cols; ++i) {
      const cv::Vec3d p = rotation * cv::Vec3d(kSquare * (i % kColumns), kSquare * (i / kColumns), 0) + shift;
      const auto pixel = camera->lens.pixel({p[2], p[0], p[1]});
      REQUIRE(pixel);
      const auto& seen = corners.at<cv::Vec2d>(view, i);
      sum_px2 += std::pow(pixel->x - seen[0], 2) + std::pow(pixel->y - seen[1], 2);
    }
  }
  const double rms_px = std::sqrt(sum_px2 / (poses.rows * corners.cols));
  CHECK(rms_px == doctest::Approx(static_cast<double>(file["rms"])).epsilon(1e-7));  // as many digits as the poses have
}

}  // namespace sigs::test
