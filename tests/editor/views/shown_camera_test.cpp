// SPDX-License-Identifier: MIT
#include "editor/views/context.h"

#include <doctest/doctest.h>

#include <memory>

#include "base/pose.h"
#include "editor/views/inspector/inspector_view.h"
#include "editor/views/view_fixture.h"
#include "editor/views/world/world_view.h"
#include "scene/scene_parts.h"
#include "spline/piecewise_cubic.h"

using namespace sigs;
using namespace sigs::editor;

namespace {

// A camera whose log leads it 10 m/s to the right from (1, 2, -150) and turns it by 90 degrees in 10 s.
struct ByLog : ViewFixture {
  explicit ByLog(glm::bvec3 moves_with_start = glm::bvec3(true)) : ViewFixture(project_of()) {
    const FootageShape shape{.size_px = {1280, 960}, .times_s = {0, 0.04}};
    OpenedScene opened{.revision = 1,
                       .project = std::make_shared<const Project>(document.project()),
                       .draft = {.scene = bare_scene(document.project(), shape)}};
    CameraMotion& motion = opened.draft.scene.motion;
    motion.path = std::make_shared<const PiecewiseCubic>(
        interpolating_spline(std::vector<TimedWaypoint>{{0, {1, 2, -150}}, {5, {1, 52, -150}}, {10, {1, 102, -150}}}));
    motion.attitudes = {{0, {1, 0, 0, 0}}, {10, rotation_of({.yaw_rad = rad_of_deg(90)})}};
    motion.moves_with_start = moves_with_start;
    shown.scene = std::make_shared<const OpenedScene>(std::move(opened));
  }
  static Project project_of() {
    Project project;
    project.camera.position_m = {1, 2, -150};
    project.camera.pitch_deg = -20;
    project.camera.speed_mps = 30;
    return project;
  }
};

}  // namespace

TEST_CASE("a log's path and turns move the camera, and its mounting tilts it") {
  ByLog it;
  const CameraPose pose = camera_pose_at(it.context, 5);
  CHECK(glm::distance(pose.translation_m, glm::dvec3(1, 52, -150)) < 1e-9);
  const Attitude attitude = attitude_of(pose.rotation);
  CHECK(deg_of_rad(attitude.yaw_rad) == doctest::Approx(45));
  CHECK(deg_of_rad(attitude.pitch_rad) == doctest::Approx(-20));
  CHECK(is_turned_by_file(it.context));
}

TEST_CASE("the camera moved at a later moment of a log takes the whole path along, at once") {
  ByLog it;
  const WorldModel model;
  WorldMoment moment{.time_s = 5, .world_from_camera = camera_pose_at(it.context, 5)};
  const WorldContext world{it.context, model, moment};
  const std::optional<Movable> camera = movable(world, {Selected::camera, 0, 0});
  REQUIRE(camera.has_value());
  move_to(world, *camera, {4, 50, -140});  // by (3, -2, 10)
  it.apply();
  CHECK(glm::distance(it.document.project().camera.position_m, glm::dvec3(4, 0, -140)) < 1e-9);
  // The scene is still the one before.
  CHECK(glm::distance(camera_pose_at(it.context, 5).translation_m, glm::dvec3(4, 50, -140)) < 1e-9);
  CHECK(glm::distance(camera_pose_at(it.context, 0).translation_m, glm::dvec3(4, 0, -140)) < 1e-9);
}

TEST_CASE("a camera whose place on the Earth is known by the log has no handle") {
  ByLog it(glm::bvec3(false));
  const WorldModel model;
  const WorldMoment moment{.time_s = 0, .world_from_camera = camera_pose_at(it.context, 0)};
  CHECK_FALSE(movable({it.context, model, moment}, {Selected::camera, 0, 0}).has_value());
  CHECK(movable({it.context, model, moment}, {Selected::light, 0, 0}).has_value());
}

TEST_CASE("the inspector names what the log gives, with its deviation in degrees") {
  CameraMotion motion;
  CHECK(lines_of_motion(motion, 0).empty());
  motion.source = {.position = "CSV: latitude_deg", .attitude = "CSV: camera_roll_deg"};
  motion.attitudes = {{0.5, {1, 0, 0, 0}}, {12.25, {1, 0, 0, 0}}};
  motion.deviations = {{0, {0.01, 0.02, 0.03}}};
  motion.readout_s = 0.0152;
  std::string all;
  for (const std::string& line : lines_of_motion(motion, 3)) all += line + "\n";
  for (const char* const part : {"CSV: latitude_deg", "CSV: camera_roll_deg", "0.50 to 12.25 s", "0.57", "15.20 ms"})
    CHECK_MESSAGE(all.find(part) != std::string::npos, part);
}
