// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <opencv2/core.hpp>
#include <pugixml.hpp>
#include <string>

#include "export/export_project.h"
#include "export/raw_video.h"
#include "frame/synthetic_scenes.h"
#include "support/files.h"

namespace sigs::test {
namespace {

constexpr int kFrames = 5;
constexpr double kRadPerDeg = std::numbers::pi / 180;

// Roll, pitch, yaw in degrees of what carries the camera, and of the camera on it.
constexpr std::array<std::array<double, 3>, kFrames> kPlatform{
    {{0, 0, 0}, {0, 0, 6}, {0, -5, 0}, {25, 0, 0}, {-12, 4.5, -7}}};
constexpr std::array<double, 3> kMount{3, -4, 8};

const cv::Vec3d kTarget_m{210, 14, -152};  // in the world
const cv::Vec3d kCamera_m{0, 0, -150};
constexpr double kSpeed_mps = 25;  // a metre a frame

// Rz(yaw) Ry(pitch) Rx(roll), written out.
cv::Matx33d rotation(const std::array<double, 3>& degrees) {
  const double r = degrees[0] * kRadPerDeg, p = degrees[1] * kRadPerDeg, y = degrees[2] * kRadPerDeg;
  const cv::Matx33d about_x(1, 0, 0, 0, std::cos(r), -std::sin(r), 0, std::sin(r), std::cos(r));
  const cv::Matx33d about_y(std::cos(p), 0, std::sin(p), 0, 1, 0, -std::sin(p), 0, std::cos(p));
  const cv::Matx33d about_z(std::cos(y), -std::sin(y), 0, std::sin(y), std::cos(y), 0, 0, 0, 1);
  return about_z * about_y * about_x;
}

std::size_t index(int frame) {
  return static_cast<std::size_t>(frame);
}

cv::Matx33d world_from_camera(int frame) {
  return rotation(kPlatform[index(frame)]) * rotation(kMount);
}

cv::Vec3d target_in_camera_m(int frame) {
  const cv::Vec3d camera_m = kCamera_m + cv::Vec3d(frame * kSpeed_mps / 25, 0, 0);
  return world_from_camera(frame).t() * (kTarget_m - camera_m);
}

// Through the pinhole of Scenario, by the formula in frames-and-units.md.
cv::Point2d target_px(int frame, cv::Size size_px) {
  const cv::Vec3d p = target_in_camera_m(frame);
  return {Scenario::kFocal_px * p[1] / p[0] + (size_px.width - 1) / 2.0,
          Scenario::kFocal_px * p[2] / p[0] + (size_px.height - 1) / 2.0};
}

// A cube that hovers before a platform that shakes wildly.
void prepare(Scenario& scenario) {
  write_footage(scenario.path("footage.mkv"), scenario.size_px(), kFrames, PixelLayout::yuv420);
  write_obj(scenario.path("cube.obj"), {{{-2, -2, -2}, {2, 2, 2}}}, 1);
  std::ofstream attitudes(scenario.path("shaken.csv"));
  attitudes << "frame,roll_deg,pitch_deg,yaw_deg\n";
  for (int n = 0; n < kFrames; ++n)
    attitudes << n << ',' << kPlatform[index(n)][0] << ',' << kPlatform[index(n)][1] << ',' << kPlatform[index(n)][2]
              << '\n';
  CameraSettings& camera = scenario.project.camera;
  camera.roll_deg = kMount[0];
  camera.pitch_deg = kMount[1];
  camera.yaw_deg = kMount[2];
  camera.speed_mps = kSpeed_mps;
  camera.attitude_file = "shaken.csv";
  scenario.add("cube.obj", {kTarget_m[0], kTarget_m[1], kTarget_m[2]});
}

void export_of(const Scenario& scenario) {
  const Result<ExportReport> report =
      export_project({.project = scenario.project, .folder = scenario.path("out"), .jobs = 2}, {});
  if (!report) FAIL(report.error().text());
}

double middle(const pugi::xml_node& box, const char* from, const char* extent) {
  return box.attribute(from).as_double() + box.attribute(extent).as_double() / 2;
}

}  // namespace

TEST_CASE("an intruder fixed in the world shakes in truth and image as the turned camera sees it") {
  Scenario scenario({320, 240}, kFrames);
  prepare(scenario);
  export_of(scenario);
  pugi::xml_document truth;
  REQUIRE(truth.load_file(scenario.path("out/lot.xml").c_str()));
  const RawVideo masks = raw_video(scenario.path("out/lot.masks.mkv"), kFrames);
  REQUIRE(masks.images.size() == kFrames);
  int n = 0;
  for (const pugi::xml_node& frame : truth.child("sigs").children("frame")) {
    CAPTURE(n);
    const pugi::xml_node intruder = frame.child("intruder");
    const cv::Vec3d p = target_in_camera_m(n);
    const char* const axes[] = {"x_m", "y_m", "z_m"};
    for (int i = 0; i < 3; ++i)  // the file has six decimals
      CHECK(std::abs(intruder.child("position").attribute(axes[i]).as_double() - p[i]) < 1e-6);
    const cv::Point2d expected = target_px(n, scenario.size_px());
    // The cube's image is its middle's up to (2 m / 210 m)^2 of the 300 px and of the way from the axis.
    CHECK(std::abs(middle(intruder.child("silhouette"), "x", "width") - expected.x) < 0.05);
    CHECK(std::abs(middle(intruder.child("silhouette"), "y", "height") - expected.y) < 0.05);
    const cv::Rect seen = box_of(masks.images[index(n)].planes[0]);
    REQUIRE(!seen.empty());  // whole pixels on both sides, and their middles half a pixel before their edges
    CHECK(std::abs(seen.x + seen.width / 2.0 - 0.5 - expected.x) <= 1);
    CHECK(std::abs(seen.y + seen.height / 2.0 - 0.5 - expected.y) <= 1);
    ++n;
  }
  CHECK(n == kFrames);
}

TEST_CASE("the annotation has the camera's attitude at its frame") {
  Scenario scenario({320, 240}, kFrames);
  prepare(scenario);
  export_of(scenario);
  pugi::xml_document truth;
  REQUIRE(truth.load_file(scenario.path("out/lot.xml").c_str()));
  int n = 0;
  for (const pugi::xml_node& frame : truth.child("sigs").children("frame")) {
    CAPTURE(n);
    const cv::Matx33d r = world_from_camera(n++);
    const pugi::xml_node camera = frame.child("camera");
    CHECK(std::abs(camera.attribute("yaw_deg").as_double() - std::atan2(r(1, 0), r(0, 0)) / kRadPerDeg) < 1e-6);
    CHECK(std::abs(camera.attribute("pitch_deg").as_double() + std::asin(r(2, 0)) / kRadPerDeg) < 1e-6);
    CHECK(std::abs(camera.attribute("roll_deg").as_double() - std::atan2(r(2, 1), r(2, 2)) / kRadPerDeg) < 1e-6);
  }
  CHECK(n == kFrames);
}

TEST_CASE("an attitude file of zeros changes no byte of an export") {
  Scenario scenario({320, 240}, kFrames);
  prepare(scenario);
  std::ofstream(scenario.path("shaken.csv")) << "frame,roll_deg,pitch_deg,yaw_deg\n0,0,0,0\n";
  export_of(scenario);
  scenario.project.camera.attitude_file.clear();
  scenario.project.name = "level";
  export_of(scenario);
  for (const char* const end : {".mkv", ".masks.mkv", ".xml"}) {
    const std::string file = end;
    const std::string bytes = text_of(scenario.path("out/lot" + file));
    CHECK_MESSAGE(bytes == text_of(scenario.path("out/level" + file)), end);
    CHECK(bytes.size() > 500);
  }
}

TEST_CASE("an export does not write over the attitude file it reads") {
  Scenario scenario({320, 240}, kFrames);
  prepare(scenario);
  std::filesystem::create_directory(scenario.path("out"));
  std::filesystem::rename(scenario.path("shaken.csv"), scenario.path("out/lot.xml"));
  scenario.project.camera.attitude_file = "out/lot.xml";
  const Result<ExportReport> report =
      export_project({.project = scenario.project, .folder = scenario.path("out"), .jobs = 1, .overwrite = true}, {});
  REQUIRE_FALSE(report.has_value());
  CHECK(report.error().text().find("is read by this export") != std::string::npos);
}

}  // namespace sigs::test
