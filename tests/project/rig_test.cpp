// SPDX-License-Identifier: MIT
#include "project/project.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "project/fields.h"
#include "project/json.h"
#include "project/validate.h"

namespace sigs::test {
namespace {

constexpr const char* kRig = R"({
  "sigs": 1, "name": "encounter",
  "cameras": [
    {"name": "front", "footage": {"video": "front.mkv", "calibration": "front.xml"}, "serial": 17},
    {"name": "left", "footage": {"video": "left.mkv", "calibration": "left.xml", "last_frame": 90},
     "mount": {"position_m": [0.1, -0.6, 0.2], "attitude_deg": {"yaw": -60}},
     "clock": {"offset_s": 0.37, "drift_ppm": 12}, "readout_s": 0.01, "appearance": {"psf_sigma_px": 0.7}}
  ],
  "camera": {"speed_mps": 22, "readout_s": 0.02},
  "appearance": {"psf_sigma_px": 0.5},
  "intruders": [{"model": {"file": "a.obj"}, "trajectory": {"waypoints": [{"position_m": [900, 0, -150]}]}}]
})";

Project rig() {
  return parse_project(kRig, "folder/p.json").value().project;
}

bool has_problem(const Project& project, const std::string& field, const std::string& what) {
  const std::vector<Problem> problems = validate(project);
  return std::any_of(problems.begin(), problems.end(), [&](const Problem& problem) {
    return problem.field == field && problem.what.find(what) != std::string::npos;
  });
}

std::string error_of(const std::string& text) {
  const auto read = parse_project(text, "p.json");
  return read ? "" : read.error().text();
}

}  // namespace

TEST_CASE("a rig is read, and what is written reads back as the same") {
  const auto read = parse_project(kRig, "folder/p.json");
  REQUIRE(read.has_value());
  REQUIRE(read->warnings.size() == 1);
  CHECK(read->warnings[0].where == "folder/p.json: cameras[0].serial");
  const Project& project = read->project;
  REQUIRE(project.cameras.size() == 2);
  CHECK(project.cameras[1].mount.position_m == glm::dvec3(0.1, -0.6, 0.2));
  CHECK(project.cameras[1].mount.yaw_deg == -60);
  CHECK(project.cameras[1].clock.offset_s == 0.37);
  CHECK_FALSE(project.cameras[0].appearance.has_value());
  CHECK(project.cameras[1].appearance->psf_sigma_px == 0.7);
  const auto again = parse_project(text_of(project), "folder/p.json");
  REQUIRE(again.has_value());
  CHECK(again->project == project);
  CHECK(text_of(project).find("\"serial\": 17") != std::string::npos);
}

TEST_CASE("a project with one camera says nothing of cameras") {
  CHECK(text_of(Project()).find("cameras") == std::string::npos);
  CHECK(seen_by_each(Project()) == std::vector<Project>{Project()});
  CHECK_FALSE(camera_named(Project(), "front").has_value());
  const Project project;
  CHECK(put_back(project, project) == project);
  CHECK(field_in_file(project, "footage.video") == "footage.video");
}

TEST_CASE("what cannot be a rig is refused") {
  CHECK(error_of(R"({"sigs": 1, "cameras": 5})").find("cameras") != std::string::npos);
  CHECK(error_of(R"({"sigs": 1, "cameras": [5]})").find("cameras[0]") != std::string::npos);
  CHECK(error_of(R"({"sigs": 1, "cameras": [{"mount": 3}]})").find("cameras[0].mount") != std::string::npos);
  CHECK(error_of(R"({"sigs": 1, "cameras": [{}], "footage": {"video": "a"}})").find("cameras[0].footage") !=
        std::string::npos);
  std::string many = R"({"sigs": 1, "cameras": [{})";
  for (std::size_t i = 0; i < kMaxCameras; ++i) many += ",{}";
  CHECK(error_of(many + "]}").find("at most 100") != std::string::npos);
}

TEST_CASE("each camera has footage and a name of its own, and the first one's clock is the rig's") {
  Project project = rig();
  project.cameras[1].footage.video.clear();
  CHECK(has_problem(project, "cameras[1].footage.video", "without footage of its own"));
  project.cameras[1].name = "front";
  CHECK(has_problem(project, "cameras[1].name", "camera before"));
  project.cameras[1].name = "a/b";
  CHECK(has_problem(project, "cameras[1].name", "/"));
  project.cameras[1].name.clear();
  CHECK(has_problem(project, "cameras[1].name", "is missing"));
  project.cameras[0].clock.drift_ppm = 1;
  CHECK(has_problem(project, "cameras[0].clock.offset_s", "must be 0"));
  project.cameras[1].mount.pitch_deg = 91;
  CHECK(has_problem(project, "cameras[1].mount.attitude_deg.pitch", "between"));
  project.cameras[1].clock.offset_s = std::numeric_limits<double>::quiet_NaN();
  CHECK(has_problem(project, "cameras[1].clock.offset_s", "finite"));
  project.cameras[1].footage.first_frame = 91;
  CHECK(has_problem(project, "cameras[1].footage.last_frame", "before"));
}

TEST_CASE("a camera sees the project with its own footage, look and shutter") {
  const Project project = rig();
  const Project front = seen_by(project, 0);
  CHECK(front.name == "encounter.front");
  CHECK(front.cameras.empty());
  CHECK(front.footage.video == "front.mkv");
  CHECK(front.camera.readout_s == 0.02);
  CHECK(front.appearance.psf_sigma_px == 0.5);
  const Project left = seen_by(project, 1);
  CHECK(left.footage.last_frame == 90);
  CHECK(left.camera.readout_s == 0.01);
  CHECK(left.camera.speed_mps == 22);
  CHECK(left.appearance.psf_sigma_px == 0.7);
  CHECK(left.rig_view->reference.video == "front.mkv");
  CHECK(field_in_file(left, "footage.calibration") == "cameras[1].footage.calibration");
  CHECK(field_in_file(left, "appearance.glare") == "cameras[1].appearance.glare");
  CHECK(field_in_file(front, "appearance.glare") == "appearance.glare");
  CHECK(field_in_file(left, "camera.speed_mps") == "camera.speed_mps");
  CHECK(camera_named(project, "left").value() == 1);
  CHECK(camera_named(project, "right").error().what.find("front, left") != std::string::npos);
}

TEST_CASE("what was changed of a view goes back to where it came from") {
  const Project project = rig();
  for (std::size_t i = 0; i < 2; ++i) CHECK(put_back(project, seen_by(project, i)) == project);

  Project left = seen_by(project, 1);
  left.footage.own_body_mask = "mask.png";
  left.camera.readout_s = 0.015;
  left.camera.speed_mps = 30;
  left.appearance.psf_sigma_px = 0.9;
  left.rig_view->mount.yaw_deg = -55;
  left.intruders.emplace_back();
  const Project changed = put_back(project, left);
  CHECK(changed.name == "encounter");
  CHECK(changed.cameras[1].footage.own_body_mask == "mask.png");
  CHECK(changed.cameras[1].readout_s == 0.015);
  CHECK(changed.cameras[1].appearance->psf_sigma_px == 0.9);
  CHECK(changed.cameras[1].mount.yaw_deg == -55);
  CHECK(changed.cameras[0] == project.cameras[0]);
  CHECK(changed.camera.readout_s == 0.02);
  CHECK(changed.camera.speed_mps == 30);
  CHECK(changed.appearance == project.appearance);
  CHECK(changed.footage == FootageSettings());
  CHECK(changed.intruders.size() == 2);

  Project front = seen_by(project, 0);
  front.appearance.psf_sigma_px = 1.1;
  front.name = "other.front";
  const Project renamed = put_back(project, front);
  CHECK(renamed.name == "other");
  CHECK(renamed.cameras[0].appearance->psf_sigma_px == 1.1);
  CHECK(renamed.appearance == project.appearance);
}

TEST_CASE("settings of a camera are set by their keys") {
  Project project = rig();
  CHECK(set_field(project, "cameras[1].mount.attitude_deg.yaw=-61").has_value());
  CHECK(project.cameras[1].mount.yaw_deg == -61);
  CHECK_FALSE(set_field(project, "footage.video=a.mkv").has_value());
  CHECK_FALSE(set_field(project, "cameras[2].name=a").has_value());
}

TEST_CASE("a mount is a rotation by yaw, pitch and roll and a shift") {
  const Pose<frame::Body, frame::Camera> pose =
      body_from_camera({.position_m = {1, 2, 3}, .roll_deg = 0, .pitch_deg = 0, .yaw_deg = -60});
  const glm::dvec3 ahead = pose * glm::dvec3(10, 0, 0);
  CHECK(glm::length(ahead - glm::dvec3(1 + 10 * 0.5, 2 - 10 * std::sqrt(0.75), 3)) < 1e-12);
}

TEST_CASE("the rig's time by offset and drift") {
  CHECK(ClockSettings().rig_time_s(123.25) == 123.25);
  CHECK(ClockSettings{.offset_s = 0.5, .drift_ppm = 100}.rig_time_s(1000) == doctest::Approx(1000.6).epsilon(1e-12));
}

}  // namespace sigs::test
