// SPDX-License-Identifier: MIT
#include "editor/views/world/world_view.h"

#include <doctest/doctest.h>
#include <imgui.h>

#include <cmath>
#include <numbers>

#include "editor/views/view_fixture.h"
#include "editor/widgets/theme.h"

using namespace sigs;
using namespace sigs::editor;

namespace {

const ScreenRect kRect{{100, 50}, {900, 650}};

Project crossing() {
  Project project;
  project.camera.position_m = {0, 0, -150};
  project.light.position_m = {200, 300, -150};
  IntruderSettings intruder;
  intruder.trajectory.waypoints = {{.frame = 0, .position_m = {400, -100, -150}},
                                   {.frame = 100, .position_m = {400, 100, -150}}};
  project.intruders = {intruder, intruder};
  for (WaypointSettings& waypoint : project.intruders[1].trajectory.waypoints) waypoint.position_m.x = 600;
  return project;
}

// A window's view of a document, without a window.
struct Bystander : ViewFixture {
  explicit Bystander(const Project& project) : ViewFixture(project) {
    ImGui::CreateContext();
    load_fonts(15);
    render_turntable.curves.push_back({.intruder = 0,
                                       .samples = {{0, 100}, {{400, -100, -150}, {400, 100, -150}}},
                                       .range_first = 0,
                                       .range_last = 100});
    moment.world_from_camera = camera_pose_at(project, 0);
  }
  ~Bystander() { ImGui::DestroyContext(); }
  Bystander(const Bystander&) = delete;
  Bystander& operator=(const Bystander&) = delete;

  [[nodiscard]] glm::dvec2 on_screen(const glm::dvec3& p_m) const { return *eye.screen_of(p_m, kRect); }
  [[nodiscard]] WorldPick pick(const glm::dvec2& mouse) { return pick_at(WorldCanvas(list, eye, kRect), world, mouse); }
  [[nodiscard]] std::optional<glm::dvec3> place(const glm::dvec2& mouse) {
    return place_for_waypoint(WorldCanvas(list, eye, kRect), world, mouse);
  }

  WorldModel render_turntable;
  WorldMoment moment;
  WorldContext world{context, render_turntable, moment};
  ImDrawList list{nullptr};
  OrbitCamera eye{.target_m = {400, 0, -150},
                  .distance_m = 1200,
                  .elevation_rad = std::numbers::pi / 2,
                  .projection = Projection::parallel};  // from above, X up
};

}  // namespace

TEST_CASE("the object under the mouse is picked: waypoint, camera, light, else the curve with its frame") {
  Bystander it(crossing());
  CHECK(it.pick(it.on_screen({400, -100, -150})).what == Selection{Selected::waypoint, 0, 0});
  CHECK(it.pick(it.on_screen({600, 100, -150}) + glm::dvec2(3, -3)).what == Selection{Selected::waypoint, 1, 1});
  CHECK(it.pick(it.on_screen({0, 0, -150})).what.kind == Selected::camera);
  CHECK(it.pick(it.on_screen({200, 300, -150})).what.kind == Selected::light);
  const WorldPick curve = it.pick(it.on_screen({400, 30, -150}) + glm::dvec2(0, 2));
  CHECK(curve.what.kind == Selected::nothing);
  REQUIRE(curve.frame.has_value());
  CHECK(*curve.frame == doctest::Approx(65));
  const WorldPick nothing = it.pick(it.on_screen({250, 30, -150}));
  CHECK(nothing.what.kind == Selected::nothing);
  CHECK_FALSE(nothing.frame.has_value());
}

TEST_CASE("of waypoints at one place the selected intruder's is picked") {
  Project project = crossing();
  project.intruders[1].trajectory.waypoints[0].position_m = {400, -100, -150};
  Bystander it(project);
  const glm::dvec2 there = it.on_screen({400, -100, -150});
  CHECK(it.pick(there).what == Selection{Selected::waypoint, 0, 0});
  it.edits.select({Selected::intruder, 1, 0});
  it.apply();
  CHECK(it.pick(there).what == Selection{Selected::waypoint, 1, 0});
}

TEST_CASE(
    "a waypoint added at a screen position is under the mouse, at the height of the camera where there is no path "
    "yet") {
  Bystander it(crossing());
  for (const double elevation_rad : {std::numbers::pi / 2, 0.5, 0.0, -0.4})
    for (const Projection projection : {Projection::parallel, Projection::perspective}) {
      it.eye.elevation_rad = elevation_rad;
      it.eye.projection = projection;
      const glm::dvec2 mouse(430, 380);
      const std::optional<glm::dvec3> place_m = it.place(mouse);
      if (!place_m) continue;  // its plane is not under the mouse
      CAPTURE(elevation_rad);
      CHECK(glm::distance(it.on_screen(*place_m), mouse) < 1e-6);
      if (elevation_rad > 0.4) CHECK(place_m->z == doctest::Approx(-150));
    }
  CHECK(it.place({430, 380}).has_value());
}

TEST_CASE("moving the camera at a later moment moves where it starts") {
  Project project = crossing();
  project.camera.speed_mps = 20;
  Bystander it(project);
  it.moment.time_s = 4;
  it.moment.world_from_camera = camera_pose_at(project, 4);
  const std::optional<Movable> camera = movable(it.world, {Selected::camera, 0, 0});
  REQUIRE(camera.has_value());
  CHECK(camera->at_m == glm::dvec3(80, 0, -150));
  move_to(it.world, *camera, {100, 5, -160});
  it.apply();
  CHECK(it.document.project().camera.position_m == glm::dvec3(20, 5, -160));
}

TEST_CASE("a deleted waypoint cannot be moved") {
  Bystander it(crossing());
  CHECK_FALSE(movable(it.world, {Selected::waypoint, 0, 2}).has_value());
  CHECK_FALSE(movable(it.world, {Selected::waypoint, 7, 0}).has_value());
  CHECK_FALSE(movable(it.world, {Selected::intruder, 0, 0}).has_value());
  REQUIRE(movable(it.world, {Selected::waypoint, 0, 1}).has_value());
  CHECK(movable(it.world, {Selected::waypoint, 0, 1})->at_m == glm::dvec3(400, 100, -150));
}

TEST_CASE("the sun is not where the point light would be, and cannot be moved") {
  Project project = crossing();
  project.light.kind = LightKind::sun;
  project.light.sun = {90, 30};
  Bystander it(project);
  CHECK(it.pick(it.on_screen({200, 300, -150})).what.kind != Selected::light);
  CHECK_FALSE(movable(it.world, {Selected::light, 0, 0}).has_value());
}
