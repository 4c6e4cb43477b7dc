// SPDX-License-Identifier: MIT

#include <doctest/doctest.h>

#include <algorithm>

#include "scene/opened_project.h"
#include "scene/plausibility.h"
#include "scene/sample_scenes.h"
#include "support/test_data.h"

using namespace sigs;
using namespace sigs::test;

namespace {

// All that is said of the project, one "field: text" a line.
std::string issues_of(const Project& project) {
  const Result<Scene> scene = open_scene(project, sample_footage());
  REQUIRE(scene);
  std::string text;
  for (const Warning& warning : warnings_of(project, *scene, estimated_visibilities(*scene, 20)))
    text += warning.text() + "\n";
  return text;
}

bool says(const std::string& text, const std::string& words) {
  return text.find(words) != std::string::npos;
}

Project head_on() {
  return sample_project("head-on");
}

}  // namespace

TEST_CASE("the sample projects have no mistakes") {
  for (const char* const name : kSampleProjects) CHECK(issues_of(sample_project(name)) == "");
}

TEST_CASE("axes that do not go with the model's shape are told, and those that do") {
  Project project = head_on();  // whose model has its nose along +x and its top along +z
  ModelSettings& model = project.intruders[0].model;
  const auto with = [&](const char* forward, const char* up) {
    model.forward = forward;
    model.up = up;
    return issues_of(project);
  };
  CHECK(says(with("+y", "+z"), "sideways"));
  CHECK(says(with("+y", "+z"), "forward to +x"));
  CHECK(says(with("-x", "+z"), "tail first"));
  CHECK(says(with("+x", "-z"), "upside down"));
  CHECK(says(with("+x", "-z"), "set up to +z"));
  CHECK(says(with("+x", "+y"), "on its side"));
  CHECK(says(with("+z", "+x"), "nose up or down"));
  CHECK(with("+x", "+z") == "");
}

TEST_CASE("a model in another unit is told, with the scale that would be right") {
  const TemporaryFolder folder;
  Project project = head_on();
  ModelSettings& model = project.intruders[0].model;
  model.file = (folder / "wedge.obj").string();
  // Something 8 m long, 11 m wide and 2.5 m high, in files of these units.
  for (const auto& [per_metre, unit] : {std::pair{1000.0, "millimetres"}, {100.0, "centimetres"}}) {
    const auto corner = [&, per = per_metre](double x, double y, double z) {
      return "v " + std::to_string(x * per) + " " + std::to_string(y * per) + " " + std::to_string(z * per) + "\n";
    };
    write_file(folder / "wedge.obj", corner(4, 0, 0) + corner(-4, 5.5, 0) + corner(-4, -5.5, 0) + corner(-4, 0, 2.5) +
                                         "f 1 2 3\nf 1 4 2\nf 1 3 4\nf 2 4 3\n");
    const std::string text = issues_of(project);
    CAPTURE(text);
    CHECK(says(text, "intruders[0].model.scale"));
    CHECK(says(text, unit));
    CHECK(says(text, "8 m long"));
  }
}

TEST_CASE("an intruder that is never in view is told where it passes") {
  Project project = head_on();
  std::vector<WaypointSettings>& waypoints = project.intruders[0].trajectory.waypoints;
  const auto at = [&](const glm::dvec3& first, const glm::dvec3& last) {
    waypoints = {{.frame = 0, .position_m = first}, {.frame = 199, .position_m = last}};
    return issues_of(project);
  };
  // The camera flies from (0, 0, -150) along X at 22 m/s; its lens sees some 65 degrees to each side.
  CHECK(says(at({20, -500, -150}, {200, -500, -150}), "left of it"));
  CHECK(says(at({20, 500, -150}, {200, 500, -150}), "right of it"));
  CHECK(says(at({200, 0, -2000}, {300, 0, -2000}), "above it"));
  CHECK(says(at({-500, 0, -150}, {-400, 0, -150}), "behind the camera"));
  CHECK(says(at({200'000, 0, -150}, {190'000, 0, -150}), "too small"));
}

TEST_CASE("heights with the wrong sign and kilometres are recognised by what would be in view") {
  Project project = head_on();
  std::vector<WaypointSettings>& waypoints = project.intruders[0].trajectory.waypoints;
  for (WaypointSettings& waypoint : waypoints) waypoint.position_m.z *= -1;
  project.camera.pitch_deg = 0;
  waypoints.pop_back();
  waypoints[0].position_m.x = 60;
  waypoints[1].position_m.x = 110;
  const std::string below = issues_of(project);
  CAPTURE(below);
  CHECK(says(below, "below the ground"));
  project = head_on();
  for (WaypointSettings& waypoint : project.intruders[0].trajectory.waypoints) waypoint.position_m /= 1000.0;
  CHECK(says(issues_of(project), "kilometres"));
}

TEST_CASE("a flight that begins after the footage is told") {
  Project project = head_on();
  for (WaypointSettings& waypoint : project.intruders[0].trajectory.waypoints) *waypoint.frame += 500;
  const std::string text = issues_of(project);
  CHECK(says(text, "intruders[0].trajectory.waypoints[0].frame"));
  CHECK(says(text, "0 to 199"));
  // Waypoints of a rig count frames of its first camera, which films ten times as long here.
  Result<Scene> scene = open_scene(project, sample_footage());
  REQUIRE(scene);
  Timeline longer{scene->footage, 0, 1999};
  for (int frame = static_cast<int>(longer.footage.times_s.size()); frame < 2000; ++frame)
    longer.footage.times_s.push_back(frame / 25.0);
  scene->timeline = std::move(longer);
  const auto told = [&] {
    std::string all;
    for (const Problem& one : lint(project, 0, *scene, 0)) all += one.field + "\n";
    return all;
  };
  CHECK_FALSE(says(told(), "waypoints[0].frame"));
  scene->timeline.reset();
  CHECK(says(told(), "waypoints[0].frame"));
}

TEST_CASE("what the method, the light or thermal footage leaves out is said once for each setting") {
  Project project = head_on();
  project.footage.cloud_distance_m = 1500;
  project.light.ground_shadow = 0.7;
  project.intruders[0].contrail.strands = 2;
  project.intruders[0].lights.strobe_cd = 400;
  const std::vector<std::string> settings{"footage.cloud_distance_m", "light.ground_shadow",
                                          "intruders[0].contrail.strands", "intruders[0].lights"};
  const auto idle_in = [&](const Project& changed) {
    std::vector<std::string> idle;
    const std::string text = issues_of(changed);
    for (const std::string& setting : settings)
      if (says(text, setting + ": has no effect")) idle.push_back(setting);
    return idle;
  };
  project.light.kind = LightKind::sun;
  project.light.sun.azimuth_deg = 100;
  project.light.sun.elevation_deg = 40;
  CHECK(idle_in(project).empty());
  Project by_lamp = project;
  by_lamp.light.kind = LightKind::point;
  CHECK(idle_in(by_lamp) == std::vector<std::string>{"light.ground_shadow"});
  for (const MethodChoice method : {MethodChoice::classic, MethodChoice::plain}) {
    Project other = project;
    other.compositing.method = method;
    CHECK(idle_in(other) == settings);
  }
  Project thermal = project;
  thermal.footage.spectrum = Spectrum::thermal;
  CHECK(idle_in(thermal) ==
        std::vector<std::string>{"light.ground_shadow", "intruders[0].contrail.strands", "intruders[0].lights"});
}

TEST_CASE("footage without a log has no mistakes, and a file that is no video neither") {
  CHECK(footage_mistakes(source_dir() / "assets/footage/sample.mp4").empty());
  CHECK(footage_mistakes(source_dir() / "README.md").empty());
  if (!has_real_data()) return;
  CHECK(footage_mistakes(real_data() / "video/air_karma_gopro_coast.mp4").empty());
}

TEST_CASE("an intruder that a lens sees behind the camera is beside the image, not behind the camera") {
  Result<Scene> scene = open_scene(head_on(), sample_footage());
  REQUIRE(scene);
  scene->last_frame = scene->first_frame + 10;  // it is still ahead of the aircraft
  scene->motion.world_from_camera_at_start.rotation = glm::angleAxis(rad_of_deg(115), glm::dvec3(0, 0, 1));
  scene->camera = {*Lens::make({.fx = 900, .fy = 900, .cx = 639.5, .cy = 479.5}), {1280, 960}};
  const Visibility pinhole = estimated_visibilities(*scene, 20).at(0);
  CHECK(pinhole.behind_camera == pinhole.frames_checked);
  CHECK(where_out_of_view(*scene, 0) == "it is behind the camera all the time");
  scene->camera = {*Lens::make({.model = LensModel::double_sphere,  // up to 126 degrees, of which the image has 80
                                .fx = 400,
                                .fy = 400,
                                .cx = 639.5,
                                .cy = 479.5,
                                .coefficients = {-0.1828, 0.5916}}),
                   {1280, 960}};
  const Visibility sphere = estimated_visibilities(*scene, 20).at(0);
  CHECK(sphere.visible == 0);
  CHECK(sphere.behind_camera == 0);
  CHECK(where_out_of_view(*scene, 0).find("degrees left of it") != std::string::npos);
}

TEST_CASE("in 360 degrees an intruder behind the own body is neither behind the camera nor beside the image") {
  Result<Scene> scene = open_scene(head_on(), sample_footage());
  REQUIRE(scene);
  scene->camera = equirectangular_camera({1280, 640});
  scene->footage.size_px = {1280, 640};
  scene->own_body = cv::Mat(640, 1280, CV_32FC1, cv::Scalar(1));
  // Away from it.
  scene->motion.world_from_camera_at_start.rotation = glm::angleAxis(rad_of_deg(180), glm::dvec3(0, 0, 1));
  const Visibility visibility = estimated_visibilities(*scene, 20).at(0);
  CHECK(visibility.occluded == visibility.frames_checked);
  CHECK(visibility.behind_camera == 0);
  CHECK(where_out_of_view(*scene, 0) == "");
}
