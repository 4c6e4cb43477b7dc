// SPDX-License-Identifier: MIT
#include "camera/rig_calibration.h"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cmath>
#include <opencv2/calib3d.hpp>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "support/test_data.h"

namespace sigs::test {
namespace {

// A rigid motion in OpenCV's axes as a 4x4 matrix: Rodrigues' vector, then the shift.
cv::Matx44d matrix_of(const cv::Vec3d& turn_rad, const cv::Vec3d& shift_m) {
  cv::Matx33d rotation;
  cv::Rodrigues(turn_rad, rotation);
  cv::Matx44d all = cv::Matx44d::eye();
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) all(row, column) = rotation(row, column);
    all(row, 3) = shift_m[row];
  }
  return all;
}

// As Kalibr writes it.
std::string rows_of(const cv::Matx44d& m, int decimals = 12) {
  std::string text;
  for (int row = 0; row < 4; ++row)
    text += fmt::format("  - [{:.{}f}, {:.{}f}, {:.{}f}, {:.{}f}]\n", m(row, 0), decimals, m(row, 1), decimals,
                        m(row, 2), decimals, m(row, 3), decimals);
  return text;
}

std::string kalibr_camera(const std::string& name, double focal_px, const std::string& rest) {
  return fmt::format(
      "{}:\n{}  cam_overlaps: [1]\n  camera_model: pinhole\n  distortion_coeffs: [-0.28, 0.07, 0.0002, 1.7e-05]\n"
      "  distortion_model: radtan\n  intrinsics: [{}, 457.296, 367.215, 248.375]\n  resolution: [752, 480]\n"
      "  rostopic: /{}/image_raw\n",
      name, rest, focal_px, name);
}

const cv::Matx44d kFirst = matrix_of({0.1, -0.7, 0.05}, {-0.11, 0.02, 0.01});
const cv::Matx44d kSecond = matrix_of({-0.2, 1.1, 0.3}, {0.05, -0.2, 0.4});

std::string chain_text() {
  return kalibr_camera("cam0", 458.654, "") + kalibr_camera("cam1", 459, "  T_cn_cnm1:\n" + rows_of(kFirst)) +
         kalibr_camera("cam2", 460, "  T_cn_cnm1:\n" + rows_of(kSecond));
}

Result<RigCalibration> rig_in(const std::string& text, const RigReading& reading = {}) {
  const TemporaryFolder folder;
  write_file(folder / "rig.yaml", text);
  return read_rig_calibration(folder / "rig.yaml", reading);
}

// The whole message, which is one line and begins with the file; empty: it was read.
std::string rig_message(const std::string& text) {
  const auto rig = rig_in(text);
  if (rig) return "";
  CHECK(rig.error().kind == ErrorKind::bad_data);
  CHECK(rig.error().text().find('\n') == std::string::npos);
  CHECK(rig.error().text().find("rig.yaml") == 0);
  return rig.error().text();
}

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

std::string replaced(std::string text, const std::string& part, const std::string& by) {
  const std::size_t at = text.find(part);
  REQUIRE(at != std::string::npos);
  return text.replace(at, part.size(), by);
}

// Where a point of one camera, in OpenCV's axes, lies in the first one by our pose, in OpenCV's axes too.
cv::Vec4d in_first(const CalibratedCamera& camera, const cv::Vec4d& p) {
  const glm::dvec3 q = optical_of(camera.first_from_camera * camera_of(glm::dvec3(p[0], p[1], p[2])));
  return {q.x, q.y, q.z, 1};
}

const cv::Vec4d kPoints[]{{0, 0, 0, 1}, {1, 0, 0, 1}, {-2, 3, 5, 1}, {0.3, -0.4, 20, 1}};

// A stereo pair as cv::stereoCalibrate gives it.
struct Pair {
  cv::Matx33d m1{500, 0, 320, 0, 501, 240, 0, 0, 1};
  cv::Matx33d m2{510, 0, 310, 0, 512, 245, 0, 0, 1};
  cv::Matx<double, 1, 5> d1{-0.2, 0.05, 0.001, -0.002, 0.01};
  cv::Matx<double, 1, 5> d2{-0.25, 0.06, -0.001, 0.001, 0};
  cv::Matx33d r;
  cv::Vec3d t{-0.2, 0.01, 0.03};
  Pair() { cv::Rodrigues(cv::Vec3d(0.02, 0.3, -0.05), r); }

  void write_intrinsics(cv::FileStorage& file) const {
    file << "M1" << cv::Mat(m1) << "D1" << cv::Mat(d1) << "M2" << cv::Mat(m2) << "D2" << cv::Mat(d2);
  }
  void write_extrinsics(cv::FileStorage& file) const { file << "R" << cv::Mat(r) << "T" << cv::Mat(t); }

  void check(const RigCalibration& rig) const {
    REQUIRE(rig.cameras.size() == 2);
    CHECK(rig.cameras[0].name == "left");
    CHECK(rig.cameras[1].name == "right");
    std::vector<cv::Point3d> points{{0.3, -0.2, 2}, {-0.5, 0.4, 3}, {0.1, 0.1, 40}, {0.2, 0.9, 5}};
    const Pose<frame::Camera, frame::FirstCamera> second_from_first = inverse(rig.cameras[1].first_from_camera);
    std::vector<cv::Point2d> first_px;
    std::vector<cv::Point2d> second_px;
    cv::projectPoints(points, cv::Vec3d(), cv::Vec3d(), m1, d1, first_px);
    cv::Vec3d turn;
    cv::Rodrigues(r, turn);
    cv::projectPoints(points, turn, t, m2, d2, second_px);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const glm::dvec3 p = camera_of({points[i].x, points[i].y, points[i].z});
      const auto first = rig.cameras[0].camera.lens.pixel(p);
      const auto second = rig.cameras[1].camera.lens.pixel(second_from_first * p);
      REQUIRE(first);
      REQUIRE(second);
      // Files have some 16 digits.
      CHECK(std::hypot(first->x - first_px[i].x, first->y - first_px[i].y) < 1e-6);
      CHECK(std::hypot(second->x - second_px[i].x, second->y - second_px[i].y) < 1e-6);
    }
  }
};

}  // namespace

TEST_CASE("the cameras of a Kalibr chain lie where the product of its matrices puts them") {
  const auto rig = rig_in(chain_text());
  REQUIRE(rig);
  REQUIRE(rig->cameras.size() == 3);
  CHECK(rig->warnings.empty());
  CHECK(rig->cameras[2].name == "cam2");
  CHECK(rig->cameras[2].camera.lens.parameters().fx == 460);
  CHECK(rig->cameras[2].camera.size_px == cv::Size(752, 480));
  CHECK_FALSE(rig->cameras[1].clock_offset_s);
  const cv::Matx44d first_from[]{cv::Matx44d::eye(), kFirst.inv(), (kSecond * kFirst).inv()};
  for (std::size_t i = 0; i < 3; ++i)
    for (const cv::Vec4d& p : kPoints) CHECK(cv::norm(in_first(rig->cameras[i], p) - first_from[i] * p) < 1e-9);
}

TEST_CASE("cameras are tied over the IMU where no link says how they lie, and their clocks by their shifts") {
  const cv::Matx44d imu[]{matrix_of({0.4, 1.2, -0.3}, {0.07, -0.02, 0.004}),
                          matrix_of({0.1, 1.4, 0.2}, {-0.04, 0, 0.1})};
  for (const bool is_inverse : {false, true}) {
    std::string text = is_inverse ? "%YAML:1.0\n" : "";  // OpenVINS writes the header of OpenCV's storage
    for (int i = 0; i < 2; ++i)
      text +=
          kalibr_camera(fmt::format("cam{}", i), 458,
                        (is_inverse ? "  T_imu_cam:\n" + rows_of(imu[i].inv()) : "  T_cam_imu:\n" + rows_of(imu[i])) +
                            fmt::format("  timeshift_cam_imu: {}\n", i == 0 ? -8.121e-05 : 0.004));
    const auto rig = rig_in(text);
    REQUIRE(rig);
    const cv::Matx44d first_from_second = imu[0] * imu[1].inv();
    for (const cv::Vec4d& p : kPoints) CHECK(cv::norm(in_first(rig->cameras[1], p) - first_from_second * p) < 1e-9);
    // t_imu = t_cam + shift: what cam1 stamps with 0 the IMU stamps with 0.004, and cam0 with 0.004 + 8.121e-05.
    REQUIRE(rig->cameras[1].clock_offset_s);
    CHECK(*rig->cameras[1].clock_offset_s == doctest::Approx(0.00408121));
    CHECK(*rig->cameras[0].clock_offset_s == 0);
  }
}

TEST_CASE("links that contradict the IMU's are named, and used") {
  std::string text = kalibr_camera("cam0", 458, "  T_cam_imu:\n" + rows_of(cv::Matx44d::eye()));
  const auto rig = rig_in(
      text + kalibr_camera("cam1", 458, "  T_cam_imu:\n" + rows_of(kSecond) + "  T_cn_cnm1:\n" + rows_of(kFirst)));
  REQUIRE(rig);
  REQUIRE(rig->warnings.size() == 1);
  CHECK(has(rig->warnings[0].text(), "cam1: T_cn_cnm1 and T_cam_imu differ"));
  CHECK(cv::norm(in_first(rig->cameras[1], kPoints[2]) - kFirst.inv() * kPoints[2]) < 1e-9);
  const auto agreeing = rig_in(
      text + kalibr_camera("cam1", 458, "  T_cam_imu:\n" + rows_of(kFirst) + "  T_cn_cnm1:\n" + rows_of(kFirst)));
  REQUIRE(agreeing);
  CHECK(agreeing->warnings.empty());
}

TEST_CASE("chains in the parameters of a ROS 2 node, in JSON and with ten cameras and more are the same") {
  std::string wrapped = "/**:\n  ros__parameters:\n";
  std::string line;
  for (const char c : chain_text()) {
    line += c;
    if (c != '\n') continue;
    wrapped += "    " + line;
    line.clear();
  }
  const auto ros = rig_in(wrapped);
  REQUIRE(ros);
  REQUIRE(ros->cameras.size() == 3);
  CHECK(cv::norm(in_first(ros->cameras[2], kPoints[2]) - (kSecond * kFirst).inv() * kPoints[2]) < 1e-9);

  std::string many = kalibr_camera("cam0", 450, "");
  for (const int i : {1, 10, 11, 2, 3, 4, 5, 6, 7, 8, 9})  // the order in which YAML's writers sort
    many +=
        kalibr_camera(fmt::format("cam{}", i), 450 + i, "  T_cn_cnm1:\n" + rows_of(matrix_of({0, 0, 0}, {-0.1, 0, 0})));
  const auto twelve = rig_in(many);
  REQUIRE(twelve);
  REQUIRE(twelve->cameras.size() == 12);
  for (std::size_t i = 0; i < 12; ++i) {
    CHECK(twelve->cameras[i].camera.lens.parameters().fx == 450 + static_cast<double>(i));
    CHECK(twelve->cameras[i].first_from_camera.translation_m.y == doctest::Approx(0.1 * static_cast<double>(i)));
  }

  const auto json = rig_in(
      R"({"cam0": {"camera_model": "pinhole", "intrinsics": [400, 400, 320, 240], "distortion_model": "equi",
      "distortion_coeffs": [0.1, 0, 0, 0], "resolution": [640, 480]}, "cam1": {"camera_model": "pinhole",
      "intrinsics": [401, 400, 320, 240], "distortion_model": "equidistant", "distortion_coeffs": [0.1, 0, 0, 0],
      "resolution": [640, 480], "T_cn_cnm1": [[1, 0, 0, -0.3], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]}})");
  REQUIRE(json);
  CHECK(json->cameras[0].camera.lens.parameters().model == LensModel::kannala_brandt);
  CHECK(json->cameras[1].first_from_camera.translation_m.y == doctest::Approx(0.3));  // to the right of the first
}

TEST_CASE("a stereo pair of OpenCV projects points as its projectPoints does, in one file of each kind") {
  const Pair pair;
  for (const char* const name : {"stereo.yml", "stereo.xml", "stereo.json"}) {
    CAPTURE(name);
    const TemporaryFolder folder;
    {
      cv::FileStorage file((folder / name).string(), cv::FileStorage::WRITE);
      pair.write_intrinsics(file);
      pair.write_extrinsics(file);
      file << "image_width" << 640 << "image_height" << 480;
    }
    const auto rig = read_rig_calibration(folder / name);
    REQUIRE(rig);
    CHECK(rig->format == "OpenCV stereo pair");
    CHECK(rig->cameras[1].camera.size_px == cv::Size(640, 480));
    pair.check(*rig);
  }
}

TEST_CASE("intrinsics.yml and extrinsics.yml are one pair, whichever is given, and the baseline is stereoRectify's") {
  const Pair pair;
  const TemporaryFolder folder;
  cv::Mat r1;
  cv::Mat r2;
  cv::Mat p1;
  cv::Mat p2;
  cv::Mat q;
  cv::stereoRectify(pair.m1, pair.d1, pair.m2, pair.d2, {640, 480}, pair.r, pair.t, r1, r2, p1, p2, q);
  {
    cv::FileStorage file((folder / "intrinsics.yml").string(), cv::FileStorage::WRITE);
    pair.write_intrinsics(file);
  }
  CHECK(has(read_rig_calibration(folder / "intrinsics.yml", {.size_px = cv::Size(640, 480)}).error().text(),
            "no R and T"));
  {
    cv::FileStorage file((folder / "extrinsics.yml").string(), cv::FileStorage::WRITE);
    pair.write_extrinsics(file);
    file << "R1" << r1 << "R2" << r2 << "P1" << p1 << "P2" << p2 << "Q" << q;
  }
  CHECK(has(read_rig_calibration(folder / "intrinsics.yml").error().text(), "no image size"));
  for (const char* const name : {"intrinsics.yml", "extrinsics.yml"}) {
    const auto rig = read_rig_calibration(folder / name, {.size_px = cv::Size(640, 480)});
    REQUIRE(rig);
    pair.check(*rig);
    // Turned by R1, the second camera lies along x, and P2 has the focal length times the distance.
    const cv::Vec4d second = in_first(rig->cameras[1], {0, 0, 0, 1});
    const cv::Mat along = r1 * cv::Mat(cv::Vec3d(second[0], second[1], second[2]));
    const double baseline_m = -p2.at<double>(0, 3) / p2.at<double>(0, 0);
    CHECK(along.at<double>(0) == doctest::Approx(baseline_m).epsilon(1e-9));
    CHECK(std::hypot(along.at<double>(1), along.at<double>(2)) < 1e-9);
  }
  const auto in_mm =
      read_rig_calibration(folder / "intrinsics.yml", {.size_px = cv::Size(640, 480), .opencv_unit_m = 0.001});
  REQUIRE(in_mm);
  CHECK(glm::length(in_mm->cameras[1].first_from_camera.translation_m) == doctest::Approx(0.001 * cv::norm(pair.t)));
}

TEST_CASE("a distance of millimetres read as metres is warned of") {
  const TemporaryFolder folder;
  Pair pair;
  pair.t = {-200, 10, 30};
  {
    cv::FileStorage file((folder / "stereo.yml").string(), cv::FileStorage::WRITE);
    pair.write_intrinsics(file);
    pair.write_extrinsics(file);
  }
  const auto rig = read_rig_calibration(folder / "stereo.yml", {.size_px = cv::Size(640, 480)});
  REQUIRE(rig);
  REQUIRE(rig->warnings.size() == 1);
  CHECK(has(rig->warnings[0].text(), "millimetres"));
}

TEST_CASE("one camera of a rig is read by its name after a #") {
  const TemporaryFolder folder;
  write_file(folder / "rig.yaml", chain_text());
  const auto last = read_calibration(folder / "rig.yaml#cam2", cv::Size(1504, 960));
  REQUIRE(last);
  CHECK(last->lens.parameters().fx == doctest::Approx(920));  // scaled to footage of twice the size
  CHECK(last->warnings.empty());
  const auto unnamed = read_calibration(folder / "rig.yaml");
  REQUIRE(unnamed);
  CHECK(unnamed->lens.parameters().fx == 458.654);
  REQUIRE(unnamed->warnings.size() == 1);
  CHECK(has(unnamed->warnings[0].text(), "rig.yaml#cam1"));
  const auto none = read_calibration(folder / "rig.yaml#cam7");
  REQUIRE_FALSE(none);
  CHECK(has(none.error().text(), "has no camera 'cam7'; it has cam0, cam1, cam2"));
  write_file(folder / "rig.yaml#cam7", kalibr_camera("cam0", 333, ""));  // a file of that name goes before
  const auto of_that_name = read_calibration(folder / "rig.yaml#cam7");
  REQUIRE(of_that_name);
  CHECK(of_that_name->lens.parameters().fx == 333);

  {
    cv::FileStorage file((folder / "stereo.yml").string(), cv::FileStorage::WRITE);
    Pair().write_intrinsics(file);
  }
  const auto left = read_calibration(folder / "stereo.yml", cv::Size(640, 480));
  const auto right = read_calibration(folder / "stereo.yml#right", cv::Size(640, 480));
  REQUIRE(left);
  REQUIRE(right);
  CHECK(left->lens.parameters().fx == 500);
  CHECK(left->warnings.empty());
  CHECK(right->lens.parameters().fx == 510);
  CHECK(right->lens.parameters().coefficients.front() == -0.25);
  write_file(folder / "one.yaml", "K: [500, 0, 320, 0, 510, 240, 0, 0, 1]\nD: []\n");
  const auto one = read_calibration(folder / "one.yaml#cam0", cv::Size(640, 480));
  REQUIRE_FALSE(one);
  CHECK(has(one.error().text(), "has no camera 'cam0'; it describes one alone"));
}

TEST_CASE("a real stereo file of OpenCV has a right camera") {
  if (!has_real_data()) return;
  const std::filesystem::path file = real_data() / "calibrations/opencv_doc_stereo_intrinsics_M1D1.yml";
  const auto right = read_calibration(file.string() + "#right", cv::Size(640, 480));
  REQUIRE(right);
  cv::FileStorage storage(file.string(), cv::FileStorage::READ);
  cv::Mat m2;
  storage["M2"] >> m2;
  CHECK(right->lens.parameters().fx == doctest::Approx(m2.at<double>(0, 0)).epsilon(1e-12));
}

TEST_CASE("Kalibr's models that look at a sphere are read with their own parameters") {
  const auto camera_of = [](const std::string& model, const std::string& intrinsics, const std::string& distortion) {
    const TemporaryFolder folder;
    write_file(folder / "cam.yaml", "cam0:\n  camera_model: " + model + "\n  intrinsics: [" + intrinsics +
                                        "]\n  distortion_model: " + distortion + "\n  resolution: [752, 480]\n");
    return read_calibration(folder / "cam.yaml");
  };
  const auto check_is = [](const Result<Camera>& camera, LensModel model, const std::vector<double>& coefficients) {
    REQUIRE_MESSAGE(camera, (camera ? "" : camera.error().text()));
    CHECK(camera->lens.parameters() == LensParameters{model, 458, 457, 367, 248, coefficients});
    CHECK(camera->size_px == cv::Size(752, 480));
  };
  const std::string radtan = "radtan\n  distortion_coeffs: [-0.28, 0.07, 0.0002, 1.7e-05]";
  const std::string none = "none\n  distortion_coeffs: []";
  check_is(camera_of("omni", "0.9, 458, 457, 367, 248", radtan), LensModel::omnidirectional,
           {0.9, -0.28, 0.07, 0.0002, 1.7e-05});
  check_is(camera_of("omni", "0.9, 458, 457, 367, 248", none), LensModel::omnidirectional, {0.9, 0, 0, 0, 0});
  check_is(camera_of("ds", "-0.2, 0.6, 458, 457, 367, 248", none), LensModel::double_sphere, {-0.2, 0.6});
  check_is(camera_of("eucm", "0.6, 1.1, 458, 457, 367, 248", none), LensModel::extended_unified, {0.6, 1.1});
  const auto message_of = [&](const std::string& model, const std::string& intrinsics, const std::string& distortion) {
    const Result<Camera> camera = camera_of(model, intrinsics, distortion);
    return camera ? "" : camera.error().text();
  };
  CHECK(message_of("x", "458, 457, 367, 248", radtan) ==
        "cam.yaml: cam0.camera_model: camera model 'x' is not known; pinhole, omni, ds and eucm are");
  CHECK(message_of("omni", "458, 457, 367, 248", radtan) ==
        "cam.yaml: cam0.intrinsics: expected 5 numbers, xi fu fv pu pv, found 4");
  CHECK(message_of("ds", "0.1, 0.5, 458, 457, 367, 248", radtan) ==
        "cam.yaml: cam0.distortion_model: 'radtan' is not supported with ds; none is");
  CHECK(has(message_of("omni", "0.9, 458, 457, 367, 248", "equidistant\n  distortion_coeffs: [1, 2, 3, 4]"),
            "'equidistant' is not supported with omni; radtan, or none, is"));
  CHECK(message_of("ds", "0.1, 0.5, 458, 457, 367, 248", "none\n  distortion_coeffs: [0.1, 0]") ==
        "cam.yaml: cam0.distortion_coeffs: has coefficients, though distortion_model is none");
  CHECK(has(message_of("eucm", "1.6, 1.1, 458, 457, 367, 248", none), "alpha, the first coefficient"));
  CHECK(has(rig_message(replaced(chain_text(), "distortion_model: radtan", "distortion_model: fov")),
            "'fov' is not supported"));
}

TEST_CASE("what is no rotation, no number, or not there is an error that names camera and field") {
  const std::string text = chain_text();
  cv::Matx44d scaled = kFirst;
  cv::Matx44d mirrored = kFirst;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) scaled(row, column) *= 1.01;
    mirrored(row, 2) *= -1;
  }
  const auto with_link = [&](const cv::Matx44d& link) {
    return kalibr_camera("cam0", 458, "") + kalibr_camera("cam1", 459, "  T_cn_cnm1:\n" + rows_of(link));
  };
  CHECK(rig_message(with_link(kFirst)).empty());
  CHECK(has(rig_message(with_link(scaled)), "cam1.T_cn_cnm1: is no rotation: its rows"));
  CHECK(has(rig_message(with_link(mirrored)), "it mirrors"));
  CHECK(has(rig_message(with_link(cv::Matx44d::zeros())), "last row"));
  CHECK(has(rig_message(with_link(matrix_of({0, 0, 0}, {-110, 2000, 0}))), "in metres"));
  CHECK(has(rig_message(replaced(text, "-0.110000000000]", ".nan]")), "cam1.T_cn_cnm1: nan is not a finite number"));
  CHECK(has(rig_message(replaced(text, "-0.110000000000]", "far]")), "'far' is not a number"));
  CHECK(has(rig_message(replaced(text, "-0.110000000000]", "1, 2]")), "expected 16 numbers"));
  CHECK(has(rig_message(replaced(text, "intrinsics: [459", "intrinsics: [459, 459")),
            "cam1.intrinsics: expected 4 numbers"));
  CHECK(has(rig_message(replaced(text, "intrinsics: [459", "intrinsics: [-459")), "focal lengths must be positive"));
  CHECK(has(rig_message(replaced(text, "resolution: [752, 480]", "resolution: [752]")),
            "cam0.resolution: expected 2 numbers"));
  const std::string unlinked = kalibr_camera("cam0", 458, "") + kalibr_camera("cam1", 459, "");
  CHECK(has(rig_message(unlinked), "cam1: the chain breaks here"));
  const std::string gap =
      kalibr_camera("cam0", 458, "") + kalibr_camera("cam2", 459, "  T_cn_cnm1:\n" + rows_of(kFirst));
  CHECK(has(rig_message(gap), "is against camera 1, which is not in the file"));
  CHECK(has(rig_message(kalibr_camera("cam0", 458, "")), "no calibration of a rig"));
  CHECK(has(rig_message("K: [500, 0, 320, 0, 510, 240, 0, 0, 1]\nD: []\n"), "no calibration of a rig"));
  const auto missing = read_rig_calibration("nowhere/rig.yaml");
  REQUIRE_FALSE(missing);
  CHECK(missing.error().kind == ErrorKind::cannot_read);
}

TEST_CASE("a rotation of three decimals is read as the nearest one") {
  const auto rig =
      rig_in(kalibr_camera("cam0", 458, "") + kalibr_camera("cam1", 459, "  T_cn_cnm1:\n" + rows_of(kFirst, 3)));
  REQUIRE(rig);
  const glm::dquat& turn = rig->cameras[1].first_from_camera.rotation;
  CHECK(glm::length(turn) == doctest::Approx(1).epsilon(1e-12));
  for (const cv::Vec4d& p : kPoints)  // each number is off by at most 5e-4
    CHECK(cv::norm(in_first(rig->cameras[1], p) - kFirst.inv() * p) < 1e-3 * (1 + cv::norm(p)));
}

TEST_CASE("a rig's file that is cut off at any byte, or has a byte changed, is read or refused in one line") {
  const TemporaryFolder folder;
  std::string stereo;
  {
    cv::FileStorage file(".yml", cv::FileStorage::WRITE | cv::FileStorage::MEMORY);
    Pair().write_intrinsics(file);
    Pair().write_extrinsics(file);
    stereo = file.releaseAndGetString();
  }
  const auto check = [&](const std::string& text) {
    write_file(folder / "rig.yaml", text);
    const auto rig = read_rig_calibration(folder / "rig.yaml", {.size_px = cv::Size(640, 480)});
    if (!rig) {
      CHECK(rig.error().text().find('\n') == std::string::npos);
      return;
    }
    CHECK(rig->cameras.size() >= 2);
    for (const CalibratedCamera& camera : rig->cameras) {
      const double length = glm::length(camera.first_from_camera.rotation);
      CHECK(std::abs(length - 1) < 1e-9);
      CHECK(glm::length(camera.first_from_camera.translation_m) < 3000);
    }
  };
  for (const std::string& text : {chain_text(), stereo}) {
    for (std::size_t length = 0; length < text.size(); ++length) check(text.substr(0, length));
    for (std::size_t at = 0; at < text.size(); at += 7)
      for (const char by : {'9', '-', ':', '[', 'n'}) {
        std::string changed = text;
        changed[at] = by;
        check(changed);
      }
  }
}

}  // namespace sigs::test
