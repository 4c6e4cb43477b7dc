// SPDX-License-Identifier: MIT
#include "labels/formats.h"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <locale>
#include <map>
#include <numbers>
#include <opencv2/calib3d.hpp>
#include <sstream>
#include <string>

#include "base/pose.h"
#include "labels/label_writing.h"
#include "support/comma_locale.h"
#include "support/files.h"
#include "support/test_data.h"

namespace sigs::test {

using namespace labels;

namespace {

namespace fs = std::filesystem;

constexpr double kPi = std::numbers::pi;

// Columns as the tracking benchmark's readme names them.
struct KittiRow {
  int frame = 0, track = 0;
  std::string type;
  int truncated = 0, occluded = 0;
  double alpha = 0, left = 0, top = 0, right = 0, bottom = 0;
  double height = 0, width = 0, length = 0, x = 0, y = 0, z = 0, rotation_y = 0;
};

KittiRow row_of(const std::string& line) {
  REQUIRE(parts_of(line, ' ').size() == 17);
  std::istringstream in(line);
  in.imbue(std::locale::classic());
  KittiRow r;
  in >> r.frame >> r.track >> r.type >> r.truncated >> r.occluded >> r.alpha >> r.left >> r.top >> r.right >>
      r.bottom >> r.height >> r.width >> r.length >> r.x >> r.y >> r.z >> r.rotation_y;
  REQUIRE_FALSE(in.fail());
  return r;
}

std::vector<KittiRow> kitti_rows(const fs::path& labels, const std::string& name = "clip") {
  std::vector<KittiRow> rows;
  for (const std::string& line : lines_of(labels / "label_02" / (name + ".txt"))) rows.push_back(row_of(line));
  return rows;
}

std::vector<KittiRow> written_kitti(const LabelSequence& clip, const std::vector<FrameTruth>& frames) {
  const TemporaryFolder folder;
  write_labels("kitti", folder / "k", clip, frames);
  return kitti_rows(folder / "k");
}

IntruderTruth at(const glm::dvec3& position_m, double yaw_deg) {
  IntruderTruth truth = visible_intruder(0, {1, 1, 2, 2});
  truth.position_m = position_m;
  truth.world_from_body = rotation_of({.yaw_rad = rad_of_deg(yaw_deg)});
  return truth;
}

KittiBox box_at(const glm::dvec3& position_m, double yaw_deg) {
  return kitti_box(frame_of(0, {}), at(position_m, yaw_deg), {-4, -5, -1}, {4, 5, 1});
}

}  // namespace

TEST_CASE("kitti counts frames from 0, tracks by id, and gives boxes by their edges") {
  const std::vector<KittiRow> rows =
      written_kitti(synthetic_sequence(100, 102, {"light aircraft", "drone"}),
                    {frame_of(100, {visible_intruder(0, {0, 0, 1, 1}), invisible_intruder(1)}),
                     frame_of(101, {invisible_intruder(0), invisible_intruder(1)}),
                     frame_of(102, {invisible_intruder(0), visible_intruder(1, {638, 478, 2, 2})})});
  REQUIRE(rows.size() == 2);
  CHECK(rows[0].frame == 0);
  CHECK(rows[0].track == 0);
  CHECK(rows[0].type == "light_aircraft");
  CHECK(rows[0].left == 0);
  CHECK(rows[0].top == 0);
  CHECK(rows[0].right == 1);
  CHECK(rows[0].bottom == 1);
  CHECK(rows[1].frame == 2);
  CHECK(rows[1].track == 1);
  CHECK(rows[1].type == "drone");
  CHECK(rows[1].right == 640);
  CHECK(rows[1].bottom == 480);
}

TEST_CASE("kitti's levels of truncation and occlusion") {
  struct Case {
    double inside, visible;
    int truncated, occluded;
  };
  for (const Case c : {Case{1, 1, 0, 0}, Case{1, 0.9, 0, 1}, Case{1, 0.5, 0, 1}, Case{1, 0.4, 0, 2},
                       Case{0.7, 0.7, 1, 0}, Case{0.5, 0.2, 1, 2}, Case{0.3, 0.3, 2, 0}, Case{0.999, 0.999, 0, 0}}) {
    IntruderTruth truth = visible_intruder(0, {1, 1, 2, 2});
    truth.inside_fraction = c.inside;
    truth.visible_fraction = c.visible;
    const std::vector<KittiRow> rows = written_kitti(synthetic_sequence(0, 0, {"airplane"}), {frame_of(0, {truth})});
    REQUIRE(rows.size() == 1);
    CHECK_MESSAGE(rows[0].truncated == c.truncated, c.inside);
    CHECK_MESSAGE(rows[0].occluded == c.occluded, c.visible << " of " << c.inside);
  }
}

TEST_CASE("kitti's heading is 0 to the right and turns as the camera's y axis has it") {
  // Straight ahead the line of sight is z, so alpha is the same.
  for (const auto& [given_deg, expected] :
       std::map<double, double>{{90, 0}, {0, -kPi / 2}, {-90, kPi}, {45, -kPi / 4}}) {
    const double yaw_deg = given_deg;
    const KittiBox box = box_at({100, 0, 0}, yaw_deg);
    CHECK_MESSAGE(std::abs(std::remainder(box.rotation_y_rad - expected, 2 * kPi)) < 1e-12, yaw_deg);
    CHECK(std::abs(std::remainder(box.alpha_rad - expected, 2 * kPi)) < 1e-12);
  }
  CHECK(std::abs(box_at({100, 0, 0}, 180).rotation_y_rad - kPi / 2) < 1e-12);  // towards the camera
}

TEST_CASE("kitti's alpha is the heading less the bearing, whatever the distance") {
  for (const double bearing_deg : {-80.0, -45.0, 0.0, 30.0, 89.0})
    for (const double yaw_deg : {-170.0, -60.0, 0.0, 90.0, 135.0})
      for (const double range_m : {20.0, 1e7}) {
        const double bearing_rad = rad_of_deg(bearing_deg);
        const KittiBox box = box_at({range_m * std::cos(bearing_rad), range_m * std::sin(bearing_rad), 3}, yaw_deg);
        const double expected_rad = rad_of_deg(yaw_deg) - kPi / 2 - bearing_rad;
        CHECK(std::abs(std::remainder(box.alpha_rad - expected_rad, 2 * kPi)) < 1e-9);
        CHECK(std::abs(box.alpha_rad) <= kPi);
        CHECK(std::abs(box.rotation_y_rad) <= kPi);
      }
}

TEST_CASE("an intruder that flies along the line of sight has the same alpha wherever it is") {
  for (const double bearing_deg : {-60.0, -10.0, 0.0, 25.0, 70.0}) {
    const double bearing_rad = rad_of_deg(bearing_deg);
    const KittiBox away = box_at({100 * std::cos(bearing_rad), 100 * std::sin(bearing_rad), 0}, bearing_deg);
    CHECK(std::abs(away.alpha_rad + kPi / 2) < 1e-12);
  }
}

// The eight corners by the readme's own formula, against the model's bounds carried over by the poses.
TEST_CASE("the corners of kitti's box are the model's where it lies level before a level camera") {
  const glm::dvec3 low(-7, -5.5, -2.5);
  const glm::dvec3 high(3, 6, 1);
  for (const double yaw_deg : {0.0, 37.0, 120.0, -150.0}) {
    FrameTruth frame = frame_of(0, {});
    frame.world_from_camera = rotation_of({.yaw_rad = rad_of_deg(20)});
    const IntruderTruth truth = at({80, -12, 5}, yaw_deg);
    const KittiBox box = kitti_box(frame, truth, low, high);
    const double c = std::cos(box.rotation_y_rad);
    const double s = std::sin(box.rotation_y_rad);
    for (int i = 0; i < 8; ++i) {
      const glm::dvec3 corner(i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z);
      const glm::dquat camera_from_body = glm::conjugate(frame.world_from_camera) * truth.world_from_body;
      const glm::dvec3 expected = optical_of(truth.position_m + camera_from_body * corner);
      // Object axes: x along the length, y down from the lower face, z to the right of a nose that points along x, of
      // which the right wing lies at -z.
      const glm::dvec3 object(i & 1 ? box.length_m / 2 : -box.length_m / 2, i & 4 ? 0 : -box.height_m,
                              i & 2 ? -box.width_m / 2 : box.width_m / 2);
      const glm::dvec3 found =
          box.bottom_optical_m + glm::dvec3(c * object.x + s * object.z, object.y, -s * object.x + c * object.z);
      CHECK(glm::distance(found, expected) < 1e-9);
    }
  }
}

TEST_CASE("a pitched and rolled body's kitti box keeps its centre and size") {
  FrameTruth frame = frame_of(0, {});
  frame.world_from_camera = rotation_of({0.3, -0.2, 1.1});
  IntruderTruth truth = at({500, 30, -20}, 40);
  truth.world_from_body = rotation_of({.roll_rad = -0.9, .pitch_rad = 0.5, .yaw_rad = rad_of_deg(40)});
  const KittiBox box = kitti_box(frame, truth, {-4, -5, -1}, {4, 5, 1});
  CHECK(box.length_m == 8);
  CHECK(box.width_m == 10);
  CHECK(box.height_m == 2);
  const glm::dvec3 center = box.bottom_optical_m - glm::dvec3(0, 1, 0);
  CHECK(glm::distance(center, glm::dvec3(30, -20, 500)) < 1e-9);  // the bounds are about the reference point
}

TEST_CASE("a nose straight up has no heading and so the heading 0") {
  IntruderTruth truth = at({100, 0, 0}, 77);
  truth.world_from_body = rotation_of({.pitch_rad = kPi / 2, .yaw_rad = rad_of_deg(77)});
  const KittiBox box = kitti_box(frame_of(0, {}), truth, {-4, -5, -1}, {4, 5, 1});
  CHECK(box.rotation_y_rad == 0);
}

TEST_CASE("kitti's row has the box's numbers") {
  const std::vector<KittiRow> rows =
      written_kitti(synthetic_sequence(0, 0, {"airplane"}), {frame_of(0, {at({100, 100, -3}, 90)})});
  REQUIRE(rows.size() == 1);
  CHECK(rows[0].height == 2);
  CHECK(rows[0].width == 10);
  CHECK(rows[0].length == 8);
  CHECK(rows[0].x == 100);
  CHECK(rows[0].y == -2);  // the lower face lies a metre below the centre
  CHECK(rows[0].z == 100);
  CHECK(rows[0].rotation_y == 0);
  CHECK(rows[0].alpha == doctest::Approx(-kPi / 4).epsilon(1e-6));
}

TEST_CASE("kitti's P2 projects a point where OpenCV projects it without distortion") {
  const TemporaryFolder folder;
  LabelSequence clip = synthetic_sequence(0, 0, {"airplane"});
  clip.camera =
      Camera{*Lens::make({.fx = 700.25, .fy = 690, .cx = 319.5, .cy = 250, .coefficients = {0, 0, 0, 0}}), {640, 480}};
  write_labels("kitti", folder / "k", clip, {});
  std::map<std::string, std::vector<double>> calib;
  for (const std::string& line : lines_of(folder / "k" / "calib" / "clip.txt")) {
    std::istringstream in(line);
    std::string name;
    in >> name;
    for (double number = 0; in >> number;) calib[name].push_back(number);
  }
  for (const char* name : {"P0:", "P1:", "P2:", "P3:", "Tr_velo_cam", "Tr_imu_velo"}) REQUIRE(calib[name].size() == 12);
  REQUIRE(calib["R_rect"].size() == 9);
  const std::vector<double>& p = calib["P2:"];
  const cv::Point3d point(3, -2, 40);
  std::vector<cv::Point2d> expected;
  const cv::Matx33d matrix(700.25, 0, 319.5, 0, 690, 250, 0, 0, 1);
  cv::projectPoints(std::vector{point}, cv::Vec3d(), cv::Vec3d(), matrix, cv::noArray(), expected);
  const double depth = p[8] * point.x + p[9] * point.y + p[10] * point.z + p[11];
  CHECK((p[0] * point.x + p[1] * point.y + p[2] * point.z + p[3]) / depth == doctest::Approx(expected[0].x));
  CHECK((p[4] * point.x + p[5] * point.y + p[6] * point.z + p[7]) / depth == doctest::Approx(expected[0].y));
  // A laser scanner's forward is the camera's z, its left -x, its up -y.
  const std::vector<double>& t = calib["Tr_velo_cam"];
  CHECK(cv::Vec3d(t[0], t[4], t[8]) == cv::Vec3d(0, 0, 1));
  CHECK(cv::Vec3d(t[1], t[5], t[9]) == cv::Vec3d(-1, 0, 0));
  CHECK(cv::Vec3d(t[2], t[6], t[10]) == cv::Vec3d(0, -1, 0));
}

TEST_CASE("kitti gives the own body in every frame as regions to ignore") {
  LabelSequence clip = synthetic_sequence(5, 6, {"airplane"});
  clip.own_body = cv::Mat::zeros(480, 640, CV_32FC1);
  clip.own_body(cv::Rect(0, 470, 640, 10)) = 1;
  const std::vector<KittiRow> rows =
      written_kitti(clip, {frame_of(5, {visible_intruder(0, {5, 5, 9, 9})}), frame_of(6, {invisible_intruder(0)})});
  REQUIRE(rows.size() == 3);
  for (const std::size_t i : {1U, 2U}) {
    CHECK(rows[i].frame == int(i) - 1);
    CHECK(rows[i].track == -1);
    CHECK(rows[i].type == "DontCare");
    CHECK(rows[i].left == 0);
    CHECK(rows[i].top == 470);
    CHECK(rows[i].right == 640);
    CHECK(rows[i].bottom == 480);
  }
}

TEST_CASE("kitti gives real aircraft of the footage as regions to ignore") {
  FrameTruth frame = frame_of(5, {visible_intruder(0, {5, 5, 9, 9})});
  frame.real_aircraft = {{20, 30, 7, 5}};
  const std::vector<KittiRow> rows = written_kitti(synthetic_sequence(5, 5, {"airplane"}), {frame});
  REQUIRE(rows.size() == 2);
  CHECK(rows[1].type == "DontCare");
  CHECK(rows[1].left == 20);
  CHECK(rows[1].bottom == 35);
}

TEST_CASE("kitti's images, list and calibration have the benchmark's paths") {
  const TemporaryFolder folder;
  LabelSequence clip = synthetic_sequence(98, 100, {"airplane"});
  clip.name = "my clip";
  clip.camera = Camera{*Lens::make({.fx = 700, .fy = 700, .cx = 320, .cy = 240}), {640, 480}};
  write_synthetic_images(folder / "images", clip);
  write_labels("kitti", folder / "k", clip, {}, folder / "images");
  CHECK(files_below(folder / "k") == std::vector<std::string>{"calib/my_clip.txt", "evaluate_tracking.seqmap.training",
                                                              "image_02/my_clip/000000.png",
                                                              "image_02/my_clip/000001.png",
                                                              "image_02/my_clip/000002.png", "label_02/my_clip.txt"});
  CHECK(text_of(folder / "k" / "image_02" / "my_clip" / "000000.png") == "98");
  CHECK(text_of(folder / "k" / "evaluate_tracking.seqmap.training") == "my_clip empty 000000 000003\n");
}

TEST_CASE("kitti leaves out objects below the thresholds") {
  LabelSequence clip = synthetic_sequence(0, 1, {"airplane"});
  clip.thresholds.min_pixels = 5;
  const std::vector<KittiRow> rows = written_kitti(
      clip, {frame_of(0, {visible_intruder(0, {1, 1, 2, 2})}), frame_of(1, {visible_intruder(0, {1, 1, 5, 1})})});
  REQUIRE(rows.size() == 1);
  CHECK(rows[0].frame == 1);
}

TEST_CASE("kitti labels do not depend on the locale") {
  const TemporaryFolder folder;
  const LabelSequence clip = synthetic_sequence(0, 0, {"airplane"});
  const CommaLocale comma;
  write_labels("kitti", folder / "k", clip, {frame_of(0, {at({1e7, 1234.5, 0}, 90)})});
  const KittiRow row = kitti_rows(folder / "k").at(0);
  CHECK(row.z == 1e7);
  CHECK(row.x == 1234.5);
}

}  // namespace sigs::test
