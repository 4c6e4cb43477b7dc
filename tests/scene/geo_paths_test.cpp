// SPDX-License-Identifier: MIT
#include "scene/geo_paths.h"

#include <doctest/doctest.h>

#include <cmath>
#include <string>

#include "geo/geo_path.h"
#include "geo/recorded_path.h"
#include "project/places.h"
#include "scene/scene_at.h"
#include "scene/scene_parts.h"

namespace sigs {
namespace {

constexpr double kUtcAtStart_s = 1'800'000'000;

Project project_on_earth() {
  Project project;
  project.geo = {.latitude_deg = 50, .longitude_deg = 8, .height_m = 100, .heading_deg = 90};
  project.camera.speed_mps = 20;
  project.intruders.resize(1);
  project.intruders[0].name = "glider";
  return project;
}

Scene scene_on_earth(const Project& project) {
  FootageShape footage{.size_px = {640, 480}};
  for (int i = 0; i <= 250; ++i) footage.times_s.push_back(i * 0.04);
  Scene scene = bare_scene(project, footage);
  scene.last_frame = 250;
  scene.earth = stated_frame(project.geo);
  scene.utc_at_frame_0_s = kUtcAtStart_s;
  return scene;
}

// Northwards at 30 m/s over the world's origin, a point each second from a minute before to a minute after.
RecordedPath northwards() {
  RecordedPath path{.name = "N1", .utc = true, .height = HeightReference::ellipsoid};
  const LocalFrame north({50, 8, 0}, 0);
  for (int t = -60; t <= 60; ++t) path.points.push_back({kUtcAtStart_s + t, north.place_of({30.0 * t, 0, -400})});
  return path;
}

}  // namespace

TEST_CASE("a frame's number and its time belong together, also at varying rates and beyond the ends") {
  FootageShape footage{.times_s = {0, 0.04, 0.04, 0.1, 0.3}, .frame_interval_s = 0.05};
  for (const double frame : {-7.5, 0.0, 0.25, 1.0, 2.5, 3.75, 4.0, 20.0})
    CHECK(frame_at_time(footage, time_of_frame_s(footage, frame)) == doctest::Approx(frame));
  CHECK(frame_at_time(footage, 0.04) == 1);
  CHECK(frame_at_time({.frame_interval_s = 0.5}, 3) == 6);
}

TEST_CASE("recorded traffic in UTC flies where and when it was") {
  const Project project = project_on_earth();
  const Scene scene = scene_on_earth(project);
  const RecordedPath path = northwards();
  const Result<std::vector<WaypointSettings>> waypoints = traffic_waypoints(path, scene, {.tolerance_m = 0.01});
  REQUIRE(waypoints);
  Project flown = project;
  take_traffic(flown, 0, *waypoints, scene);
  const Result<Trajectory, Problem> trajectory = scene_trajectory(flown, 0, scene);
  REQUIRE(trajectory);
  for (const double t : {0.0, 2.5, 9.96}) {
    // World X is east, so north is -Y; 400 m above the ellipsoid is 300 m above the world's plane.
    const glm::dvec3 expected(0, -30 * t, -300);
    CHECK(glm::distance(trajectory->position_m(t), expected) < 0.05);
  }
  CHECK(flown.geo == project.geo);
}

TEST_CASE("traffic without UTC begins at the frame that is given, and heights may be shifted") {
  const Project project = project_on_earth();
  Scene scene = scene_on_earth(project);
  scene.utc_at_frame_0_s.reset();
  const RecordedPath path = northwards();
  CHECK(traffic_waypoints(path, scene, {}).error().kind == ErrorKind::usage);
  const auto waypoints = traffic_waypoints(path, scene, {.at_frame = 25, .height_offset_m = 50});
  REQUIRE(waypoints);
  CHECK(waypoints->front().frame == doctest::Approx(25));
  // 1800 m from the origin, where the world is flat: d^2 / 2R above 400 m, and the offset.
  CHECK(waypoints->front().place->height_m == doctest::Approx(450 + 1800.0 * 1800 / (2 * 6.38e6)).epsilon(1e-5));
}

TEST_CASE("traffic that cannot be placed is an error that says why") {
  const Project project = project_on_earth();
  Scene scene = scene_on_earth(project);
  RecordedPath path = northwards();
  for (TimedPlace& point : path.points) point.time_s += 1e6;
  CHECK(traffic_waypoints(path, scene, {}).error().what.find("nowhere near") != std::string::npos);
  path.has_times = false;
  CHECK(traffic_waypoints(path, scene, {}).error().what.find("no times") != std::string::npos);
  scene.earth.reset();
  CHECK(traffic_waypoints(northwards(), scene, {}).error().where == "geo");
}

TEST_CASE("a long record is cut to the scene's time, and the cut ends lie on it") {
  const Scene scene = scene_on_earth(project_on_earth());
  const auto waypoints = traffic_waypoints(northwards(), scene, {.tolerance_m = 0});
  REQUIRE(waypoints);
  CHECK(waypoints->front().frame == doctest::Approx(-250));
  CHECK(waypoints->back().frame == doctest::Approx(500));
  CHECK(glm::distance(waypoints->front().position_m, glm::dvec3(0, 300, -300)) < 0.05);
}

TEST_CASE("a path across the antimeridian is cut the short way") {
  Project project = project_on_earth();
  project.geo.longitude_deg = 180;
  const Scene scene = scene_on_earth(project);
  RecordedPath path{.name = "N1", .utc = true};
  path.points = {{kUtcAtStart_s - 100, {50, 179.9, 200}}, {kUtcAtStart_s + 100, {50, -179.9, 200}}};
  const auto waypoints = traffic_waypoints(path, scene, {});
  REQUIRE(waypoints);
  for (const WaypointSettings& waypoint : *waypoints) CHECK(std::abs(waypoint.position_m.x) < 2000);
}

TEST_CASE("an encounter written as KML and read again is where the scene has it") {
  const Project project = project_on_earth();
  Scene scene = scene_on_earth(project);
  const auto trajectory = Trajectory::make({{0, {500, 100, -200}}, {5, {480, 0, -210}}, {10, {700, -90, -190}}}, {});
  REQUIRE(trajectory);
  scene.intruders.push_back({.name = "glider", .trajectory = *trajectory});
  const std::string text = kml_text(geo_paths_of(scene), "encounter");
  const auto read = recorded_paths_of(text, "encounter.kml");
  REQUIRE(read);
  REQUIRE(read->size() == 2);
  for (std::size_t i = 0; i < 2; ++i) {
    REQUIRE(read->at(i).points.size() == 251);
    for (const TimedPlace& point : read->at(i).points) {
      const double t = point.time_s - kUtcAtStart_s;
      const glm::dvec3 expected = i == 0 ? camera_at(scene.motion, t).translation_m : trajectory->position_m(t);
      CHECK(glm::distance(scene.earth->world_of(point.place), expected) < 1e-3);
    }
  }
}

TEST_CASE("attitudes are written against north") {
  const Scene scene = scene_on_earth(project_on_earth());
  const GeoPath camera = geo_paths_of(scene).at(0);
  REQUIRE(camera.attitudes.at(0));
  CHECK(camera.attitudes[0]->yaw_rad == doctest::Approx(rad_of_deg(90)));
}

}  // namespace sigs
