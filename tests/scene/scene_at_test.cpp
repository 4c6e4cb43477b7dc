// SPDX-License-Identifier: MIT
#include "scene/scene_at.h"

#include <doctest/doctest.h>

#include <cmath>
#include <fstream>
#include <numbers>
#include <utility>

#include "base/pose.h"
#include "scene/opened_project.h"
#include "scene/sample_scenes.h"

using namespace sigs;
using namespace sigs::test;

namespace {

// A camera at 1000 m, and intruders that hover at given places; no models, no footage: only poses.
Scene scene_with(const std::vector<glm::dvec3>& positions_m, const Attitude& camera_attitude, double speed_mps) {
  Scene scene{.camera = {*Lens::make({}), {640, 480}}};
  scene.motion = {{rotation_of(camera_attitude), {0, 0, -1000}}, speed_mps};
  scene.light.position_m = {0, 0, -5000};
  scene.footage = {.size_px = {640, 480}, .times_s = {0, 1, 2}, .frame_interval_s = 1};
  scene.last_frame = 2;
  for (const glm::dvec3& position_m : positions_m)
    scene.intruders.push_back({"hovering", nullptr, *Trajectory::make({{0, position_m}}, {})});
  return scene;
}

PlatformAttitude turned(double time_s, const Attitude& attitude) {
  return {time_s, rotation_of(attitude)};
}

Attitude attitude_at(const CameraMotion& motion, double time_s) {
  return attitude_of(camera_at(motion, time_s).rotation);
}

}  // namespace

TEST_CASE("an intruder ahead and right and above lies so in the camera frame") {
  const SceneMoment moment = scene_at(scene_with({{100, 20, -1030}}, {}, 0), 0);
  CHECK(glm::distance(moment.intruders[0].camera_from_body.translation_m, glm::dvec3(100, 20, -30)) < 1e-12);
}

TEST_CASE("the camera flies along world X at its speed") {
  const SceneMoment moment = scene_at(scene_with({{100, 0, -1000}}, {}, 30), 2);
  CHECK(moment.time_s == 2);
  CHECK(moment.world_from_camera.translation_m.x == 60);
  CHECK(moment.intruders[0].camera_from_body.translation_m.x == doctest::Approx(40));
}

TEST_CASE("a camera that looks right sees what is to the right ahead") {
  const SceneMoment moment = scene_at(scene_with({{0, 50, -1000}}, {0, 0, std::numbers::pi / 2}, 0), 0);
  CHECK(glm::distance(moment.intruders[0].camera_from_body.translation_m, glm::dvec3(50, 0, 0)) < 1e-12);
}

TEST_CASE("a camera that rolls right sees the horizon's right end rise") {
  const SceneMoment moment = scene_at(scene_with({{100, 50, -1000}}, {rad_of_deg(10), 0, 0}, 0), 0);
  CHECK(moment.intruders[0].camera_from_body.translation_m.z < 0);  // above the axis
}

TEST_CASE("intruders are ordered from far to near and equal ones by their number") {
  const SceneMoment moment = scene_at(scene_with({{10, 0, -1000}, {99, 0, -1000}, {99, 0, -1000}}, {}, 0), 0);
  CHECK(moment.intruders[0].id == 1);
  CHECK(moment.intruders[1].id == 2);
  CHECK(moment.intruders[2].id == 0);
}

TEST_CASE("ten thousand kilometres from the origin the difference is still exact") {
  Scene scene = scene_with({{1e7 + 100, 1e7 + 0.25, -1000}}, {}, 0);
  scene.motion.world_from_camera_at_start.translation_m = {1e7, 1e7, -1000};
  const SceneMoment moment = scene_at(scene, 0);
  CHECK(moment.intruders[0].camera_from_body.translation_m == glm::dvec3(100, 0.25, 0));
}

TEST_CASE("the light is given in the camera frame") {
  const SceneMoment moment = scene_at(scene_with({}, {}, 0), 0);
  CHECK(moment.light_in_camera == glm::dvec3(0, 0, -4000));
}

TEST_CASE("between two known attitudes the camera rotates evenly, before and after them it is fixed") {
  const CameraMotion motion{.attitudes = {turned(1, {0, 0, rad_of_deg(10)}), turned(3, {0, 0, rad_of_deg(20)}),
                                          turned(4, {rad_of_deg(-6), 0, rad_of_deg(20)})}};
  for (const auto& [time_s, yaw_deg] : {std::pair(-5.0, 10.0), {1.0, 10.0}, {1.5, 12.5}, {2.9, 19.5}, {9.0, 20.0}})
    CHECK(attitude_at(motion, time_s).yaw_rad == doctest::Approx(rad_of_deg(yaw_deg)));
  CHECK(attitude_at(motion, 3.5).roll_rad == doctest::Approx(rad_of_deg(-3)));
  CHECK(attitude_at(motion, 1e9).roll_rad == doctest::Approx(rad_of_deg(-6)));
}

TEST_CASE("from 170 degrees to -170 the camera rotates the shorter way") {
  const CameraMotion motion{.attitudes = {turned(0, {0, 0, rad_of_deg(170)}), turned(4, {0, 0, rad_of_deg(-170)})}};
  CHECK(attitude_at(motion, 1).yaw_rad == doctest::Approx(rad_of_deg(175)));
  CHECK(attitude_at(motion, 3).yaw_rad == doctest::Approx(rad_of_deg(-175)));
}

TEST_CASE("one known attitude applies to all times and none leaves the attitude unchanged, bit for bit") {
  const Attitude mean{0.1, -0.2, 0.3};
  CameraMotion motion{.world_from_camera_at_start = {rotation_of(mean), {1, 2, 3}}};
  CHECK(camera_at(motion, 7).rotation == rotation_of(mean));
  motion.attitudes = {turned(2, {0, 0, rad_of_deg(30)})};
  for (const double time_s : {-1e9, 0.0, 2.0, 1e9})
    CHECK(attitude_at(motion, time_s).yaw_rad == doctest::Approx(0.3 + rad_of_deg(30)));
}

TEST_CASE("the camera rotates with its platform: about the platform's axes and not about its own") {
  // A camera that looks 30 degrees down, on a platform that points to the right.
  const CameraMotion motion{.world_from_camera_at_start = {rotation_of({0, rad_of_deg(-30), 0}), {}},
                            .attitudes = {turned(0, {0, 0, rad_of_deg(90)})}};
  const glm::dvec3 axis = camera_at(motion, 0).rotation * glm::dvec3(1, 0, 0);
  CHECK(glm::distance(axis, glm::dvec3(0, std::cos(rad_of_deg(30)), 0.5)) < 1e-12);
}

TEST_CASE("the platform's rotations do not move the camera") {
  const CameraMotion motion{.world_from_camera_at_start = {{1, 0, 0, 0}, {5, 6, -150}},
                            .speed_mps = 22,
                            .attitudes = {turned(0, {0.3, 0.2, 0.1}), turned(9, {-0.3, 0.1, 1.5})}};
  CHECK(camera_at(motion, 4).translation_m == glm::dvec3(93, 6, -150));
}

TEST_CASE("an attitude file's frames have the footage's times, also where its rate varies") {
  const TemporaryFolder folder;
  std::ofstream(folder / "gyro.csv") << "frame,roll_deg,pitch_deg,yaw_deg\n0,0,0,0\n1,0,0,10\n2,0,0,20\n";
  Project project = sample_project("crossing");
  project.camera.attitude_file = (folder / "gyro.csv").string();
  FootageShape footage = sample_footage();
  footage.times_s[1] = 0.01;  // comes early: half of the turn is done in a quarter of the time
  footage.times_s[2] = 0.08;
  const Scene scene = open_scene(project, footage).value();
  REQUIRE(scene.motion.attitudes.size() == 3);
  CHECK(attitude_of(scene_at(scene, 1).world_from_camera.rotation).yaw_rad == doctest::Approx(rad_of_deg(10)));
  CHECK(attitude_at(scene.motion, 0.045).yaw_rad == doctest::Approx(rad_of_deg(15)));
  CHECK(attitude_of(scene_at(scene, 150).world_from_camera.rotation).yaw_rad == doctest::Approx(rad_of_deg(20)));
}

TEST_CASE("frames of the same presentation time give finite numbers") {
  const CameraMotion motion{.attitudes = {turned(1, {}), turned(1, {0, 0, 0.2}), turned(2, {0, 0, 0.4})}};
  CHECK(attitude_at(motion, 1).yaw_rad == doctest::Approx(0.2));
  CHECK(attitude_at(motion, 0.5).yaw_rad == doctest::Approx(0));
  CHECK(attitude_at(motion, 1.5).yaw_rad == doctest::Approx(0.3));
}
