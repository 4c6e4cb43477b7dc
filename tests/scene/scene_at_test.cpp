// SPDX-License-Identifier: MIT
#include "scene/scene_at.h"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "base/angles.h"

using namespace sigs;

namespace {

// A camera at 1000 m, and intruders that hover where they are put; no models, no footage: only where things are.
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

TEST_CASE("intruders come far to near and equal ones by their number") {
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

TEST_CASE("the light is given where the camera sees it") {
  const SceneMoment moment = scene_at(scene_with({}, {}, 0), 0);
  CHECK(moment.light_in_camera == glm::dvec3(0, 0, -4000));
}
