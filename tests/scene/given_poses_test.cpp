// SPDX-License-Identifier: MIT
#include "scene/posed_intruder.h"

#include <doctest/doctest.h>

#include <limits>
#include <vector>

#include "scene/scene_at.h"

namespace sigs::test {
namespace {

constexpr int kFrame = 1;

// Two intruders that hover, seen by a camera that flies and turns.
Scene two_hovering() {
  Scene scene{.camera = {*Lens::make({}), {640, 480}}};
  scene.motion = {{rotation_of({0.1, 0.2, 0.3}), {0, 0, -100}}, 30};
  scene.motion.attitudes = {{0, rotation_of({0, 0, 0})}, {2, rotation_of({0.4, 0, 0})}};
  scene.motion.source = {"a log", "a log"};
  scene.footage = {.size_px = {640, 480}, .times_s = {0, 1, 2}, .frame_interval_s = 1};
  scene.last_frame = 2;
  for (const double y_m : {-20.0, 20.0})
    scene.intruders.push_back({"hovering", nullptr, *Trajectory::make({{0, {500, y_m, -100}}}, {})});
  return scene;
}

double distance_between(const glm::dvec3& a, const glm::dvec3& b) {
  return glm::length(a - b);
}

}  // namespace

TEST_CASE("an intruder has the position and the attitude given, and the others theirs") {
  const Scene own = two_hovering();
  const Attitude attitude{0.3, -0.2, 2.5};
  const Result<Scene> given =
      with_poses(own, kFrame, {.intruders = {{.intruder = 1, .pose = {{900, -50, -300}, attitude, {0, 0, 0}}}}});
  REQUIRE(given.has_value());
  const Pose<frame::World, frame::Body> pose = given->intruders[1].trajectory.world_from_body(1);
  CHECK(pose.translation_m == glm::dvec3(900, -50, -300));
  const Attitude back = attitude_of(pose.rotation);
  CHECK(back.roll_rad == doctest::Approx(0.3));
  CHECK(back.pitch_rad == doctest::Approx(-0.2));
  CHECK(back.yaw_rad == doctest::Approx(2.5));
  CHECK(camera_from_body_at(*given, 0, 1).translation_m == camera_from_body_at(own, 0, 1).translation_m);
}

TEST_CASE("around its frame a body goes on at the velocity given, without turning") {
  const glm::dvec3 velocity_mps(10, -60, 4);
  const Result<Scene> given =
      with_poses(two_hovering(), kFrame,
                 {.camera = GivenPose{{7, 8, -9}, {0, 0, 0.5}, {3, 0, 0}},
                  .intruders = {{.intruder = 0, .pose = {{100, 0, 0}, {0, 0, 1}, velocity_mps}}}});
  REQUIRE(given.has_value());
  for (const double since_s : {-0.02, -0.001, 0.0, 0.001, 0.02}) {
    const Pose<frame::World, frame::Body> body = given->intruders[0].trajectory.world_from_body(1 + since_s);
    CHECK(distance_between(body.translation_m, glm::dvec3(100, 0, 0) + since_s * velocity_mps) < 1e-12);
    CHECK(attitude_of(body.rotation).yaw_rad == doctest::Approx(1));
    const Pose<frame::World, frame::Camera> camera = camera_at(given->motion, 1 + since_s);
    CHECK(distance_between(camera.translation_m, {7 + 3 * since_s, 8, -9}) < 1e-12);
    CHECK(attitude_of(camera.rotation).yaw_rad == doctest::Approx(0.5));
    CHECK(attitude_of(camera.rotation).roll_rad == doctest::Approx(0));
  }
  CHECK(given->horizon_is_known);
  CHECK(given->motion.source.position == "given");
}

TEST_CASE("a pose of a camera of a rig is that of the camera itself, its mounting included") {
  Scene own = two_hovering();
  own.motion.mount = Pose<frame::Body, frame::Camera>{rotation_of({0, 0, -1}), {0.1, -0.6, 0}};
  const Result<Scene> given = with_poses(own, kFrame, {.camera = GivenPose{{7, 8, -9}, {0, 0, 0.5}, {3, 0, 0}}});
  REQUIRE(given.has_value());
  const Pose<frame::World, frame::Camera> camera = camera_at(given->motion, 1);
  CHECK(distance_between(camera.translation_m, {7, 8, -9}) < 1e-12);
  CHECK(attitude_of(camera.rotation).yaw_rad == doctest::Approx(0.5));
}

TEST_CASE("the camera's own poses given back change nothing") {
  const Scene own = two_hovering();
  const Pose<frame::World, frame::Camera> pose = camera_at(own.motion, 1);
  const Result<Scene> given =
      with_poses(own, kFrame, {.camera = GivenPose{pose.translation_m, attitude_of(pose.rotation), {30, 0, 0}}});
  REQUIRE(given.has_value());
  const SceneMoment before = scene_at(own, kFrame);
  const SceneMoment after = scene_at(*given, kFrame);
  REQUIRE(before.intruders.size() == after.intruders.size());
  for (std::size_t i = 0; i < before.intruders.size(); ++i) {
    CHECK(before.intruders[i].id == after.intruders[i].id);
    CHECK(distance_between(before.intruders[i].camera_from_body.translation_m,
                           after.intruders[i].camera_from_body.translation_m) < 1e-9);
  }
}

TEST_CASE("numbers that are not finite, far places and intruders that there are not are refused") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double inf = std::numeric_limits<double>::infinity();
  const std::vector<GivenPose> wrong{{{nan, 0, 0}},
                                     {{0, 0, inf}},
                                     {{0, 2e8, 0}},
                                     {{0, 0, 0}, {nan, 0, 0}},
                                     {{0, 0, 0}, {0, inf, 0}},
                                     {{0, 0, 0}, {}, {0, nan, 0}},
                                     {{0, 0, 0}, {}, {2e6, 0, 0}}};
  for (const GivenPose& pose : wrong) {
    const Result<Scene> camera = with_poses(two_hovering(), kFrame, {.camera = pose});
    REQUIRE(!camera);
    CHECK(camera.error().where == "camera");
    CHECK(camera.error().kind == ErrorKind::usage);
    const Result<Scene> intruder = with_poses(two_hovering(), kFrame, {.intruders = {{1, pose}}});
    REQUIRE(!intruder);
    CHECK(intruder.error().where == "intruder 1");
  }
  for (const int index : {-1, 2}) CHECK(!with_poses(two_hovering(), kFrame, {.intruders = {{index, {}}}}));
}

}  // namespace sigs::test
