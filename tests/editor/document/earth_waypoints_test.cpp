// SPDX-License-Identifier: MIT
// Waypoints that are places on the Earth, while they are edited.
#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "editor/document/document.h"
#include "editor/document/project_edits.h"
#include "project/places.h"

using namespace sigs;
using namespace sigs::editor;

namespace {

constexpr double kEquatorRadius_m = 6378137;  // WGS-84
constexpr double kDegrees = 180 / std::numbers::pi;

// The world's origin on the equator, X to the north: there a metre to the east is a degree of longitude by the
// equator's radius.
Project on_the_equator() {
  Project project;
  project.geo = {.latitude_deg = 0.0, .longitude_deg = 10.0, .height_m = 0.0, .heading_deg = 0.0};
  IntruderSettings intruder;
  for (const double frame : {0.0, 100.0}) {
    WaypointSettings waypoint{.frame = frame};
    waypoint.place = {.latitude_deg = 0, .longitude_deg = 10 + frame / kEquatorRadius_m * kDegrees, .height_m = 50};
    intruder.trajectory.waypoints.push_back(waypoint);
  }
  project.intruders.push_back(intruder);
  place_waypoints(project);
  return project;
}

const WaypointSettings& waypoint_of(const Document& document, std::size_t intruder, std::size_t waypoint) {
  return document.project().intruders.at(intruder).trajectory.waypoints.at(waypoint);
}

}  // namespace

TEST_CASE("a place that is dragged in the world is the place where it was let go") {
  Document document(on_the_equator());
  CHECK(waypoint_of(document, 0, 1).position_m.y == doctest::Approx(100).epsilon(1e-4));
  Edits edits;
  edits.move_waypoint(0, 1, {0, 300, -20}, "drag");
  edits.end_gesture();
  document.apply(edits.take_edits());
  const PlaceSettings place = waypoint_of(document, 0, 1).place.value();
  // 300 m along the tangent: the arc is shorter by (300 / R)^2 / 3, less than a micrometre.
  CHECK((place.longitude_deg - 10) / kDegrees * kEquatorRadius_m == doctest::Approx(300).epsilon(1e-5));
  CHECK(place.height_m == doctest::Approx(20 + 300 * 300 / (2 * kEquatorRadius_m)).epsilon(1e-6));
  CHECK(waypoint_of(document, 0, 1).position_m == glm::dvec3(0, 300, -20));
  document.apply(Edit(Undo{}));
  CHECK(waypoint_of(document, 0, 1).place->height_m == 50);
}

TEST_CASE("places stay where they are when the world's X axis gets another heading") {
  Document document(on_the_equator());
  document.apply(Edit(ChangeProject{"turn", [](Project& project) { project.geo.heading_deg = 90; }, {}}));
  CHECK(waypoint_of(document, 0, 1).position_m.x == doctest::Approx(100).epsilon(1e-4));  // east is ahead
  CHECK(std::abs(waypoint_of(document, 0, 1).position_m.y) < 1e-3);
}

TEST_CASE("a waypoint added among places is a place, one added among points of the world is none") {
  Project project = on_the_equator();
  const auto earth = stated_frame(project.geo);
  TrajectoryPlan& plan = project.intruders[0].trajectory;
  REQUIRE(put_waypoint(plan, 50, {0, 40, -30}, {0, 100}, earth) == 1);
  REQUIRE(plan.waypoints[1].place.has_value());
  CHECK((plan.waypoints[1].place->longitude_deg - 10) / kDegrees * kEquatorRadius_m ==
        doctest::Approx(40).epsilon(1e-5));
  plan.waypoints[0].place.reset();
  REQUIRE(put_waypoint(plan, 70, {0, 40, -30}, {0, 50, 100}, earth) == 2);
  CHECK_FALSE(plan.waypoints[2].place.has_value());
}

TEST_CASE("the copy of a place lies between it and the next, in the world and on the Earth") {
  Document document(on_the_equator());
  document.apply(Edit(
      ChangeProject{"duplicate",
                    [](Project& project) {
                      (void)duplicate_waypoint(project.intruders[0].trajectory, 0, {0, 100}, stated_frame(project.geo));
                    },
                    {}}));
  const WaypointSettings copy = waypoint_of(document, 0, 1);
  CHECK(copy.position_m.y == doctest::Approx(50).epsilon(1e-4));
  CHECK((copy.place.value().longitude_deg - 10) / kDegrees * kEquatorRadius_m == doctest::Approx(50).epsilon(1e-4));
}

TEST_CASE("a change that changes nothing makes no step, also after a place was dragged") {
  Document document(on_the_equator());
  Edits edits;
  edits.move_waypoint(0, 1, {12.3, 45.6, -78.9}, "");
  document.apply(edits.take_edits());
  const std::uint64_t moved = document.revision().number;
  document.apply(Edit(ChangeProject{"nothing", [](Project&) {}, {}}));
  CHECK(document.revision().number == moved);
}

TEST_CASE("numbers of log and place that are not finite are refused") {
  Document document(on_the_equator());
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::uint64_t before = document.revision().number;
  document.apply(Edit(ChangeProject{"a", [=](Project& p) { p.camera.track.offset_s = nan; }, {}}));
  document.apply(Edit(ChangeProject{"b", [=](Project& p) { p.geo.heading_deg = nan; }, {}}));
  document.apply(Edit(ChangeProject{"c", [=](Project& p) { p.camera.readout_s = nan; }, {}}));
  document.apply(
      Edit(ChangeProject{"d", [=](Project& p) { p.intruders[0].trajectory.waypoints[0].place->height_m = nan; }, {}}));
  CHECK(document.revision().number == before);
}
