// SPDX-License-Identifier: MIT
#include "project/places.h"

#include <doctest/doctest.h>

#include <string>

#include "project/fields.h"
#include "project/json.h"
#include "project/validate.h"

namespace sigs {
namespace {

const char* const kText = R"({"sigs": 1, "name": "n",
  "geo": {"latitude_deg": 50, "longitude_deg": 8, "height_m": 100, "heading_deg": 90},
  "intruders": [{"trajectory": {"waypoints": [
    {"frame": 0, "latitude_deg": 50, "longitude_deg": 8, "height_m": 250},
    {"frame": 9, "position_m": [1, 2, 3]}]}}]})";

Project read_text_of(const std::string& text) {
  const Result<ReadProject> read = parse_project(text, "p.json");
  if (!read) FAIL(read.error().text());
  for (const Warning& warning : read->warnings) FAIL_CHECK(warning.text());
  return read->project;
}

WaypointSettings& waypoint(Project& project, std::size_t i) {
  return project.intruders.at(0).trajectory.waypoints.at(i);
}

bool has_problem(const Project& project, const std::string& field) {
  for (const Problem& problem : validate(project))
    if (problem.field == field) return true;
  return false;
}

}  // namespace

TEST_CASE("a waypoint on the Earth has its position in the world, and both are saved") {
  Project project = read_text_of(kText);
  CHECK(glm::distance(waypoint(project, 0).position_m, glm::dvec3(0, 0, -150)) < 1e-6);
  CHECK_FALSE(waypoint(project, 1).place);
  const Project again = read_text_of(text_of(project));
  CHECK(again.intruders[0].trajectory.waypoints[0].place == waypoint(project, 0).place);
  CHECK(text_of(again) == text_of(project));
}

TEST_CASE("a place that is not whole is an error that names the number") {
  for (const char* const key : {"latitude_deg", "longitude_deg", "height_m"}) {
    std::string text = kText;
    const std::size_t list = text.find("\"frame\": 0");
    text.replace(text.find(key, list), std::string(key).size(), std::string("x_") + key);
    const Result<ReadProject> read = parse_project(text, "p.json");
    REQUIRE_FALSE(read);
    CHECK(read.error().where.find(std::string("waypoints[0].") + key) != std::string::npos);
  }
}

TEST_CASE("a place needs the world's own, all of it") {
  Project project = read_text_of(kText);
  CHECK_FALSE(has_problem(project, "intruders[0].trajectory.waypoints[0].latitude_deg"));
  project.geo.heading_deg.reset();
  CHECK(has_problem(project, "intruders[0].trajectory.waypoints[0].latitude_deg"));
  project.geo.longitude_deg.reset();
  CHECK(has_problem(project, "geo.longitude_deg"));
}

TEST_CASE("a waypoint that is moved gets the place where it is; one whose place changes moves") {
  const Project before = read_text_of(kText);
  Project after = before;
  waypoint(after, 0).position_m = {0, -1000, -150};  // world X points east, so -Y is north
  keep_places(before, after);
  const LocalFrame earth = *stated_frame(after.geo);
  CHECK(waypoint(after, 0).place->latitude_deg > 50.0089);
  CHECK(waypoint(after, 0).place->longitude_deg == doctest::Approx(8).epsilon(1e-12));
  CHECK(glm::distance(earth.world_of({waypoint(after, 0).place->latitude_deg, waypoint(after, 0).place->longitude_deg,
                                      waypoint(after, 0).place->height_m}),
                      waypoint(after, 0).position_m) < 1e-6);

  Project moved = after;
  moved.geo.latitude_deg = 50.001;  // the world goes, the place stays
  keep_places(after, moved);
  CHECK(waypoint(moved, 0).place == waypoint(after, 0).place);
  CHECK(waypoint(moved, 0).position_m.y > -900);
}

TEST_CASE("a place is set by its keys") {
  Project project = read_text_of(kText);
  REQUIRE(set_field(project, "intruders[0].trajectory.waypoints[0].height_m=350"));
  CHECK(waypoint(project, 0).position_m.z == doctest::Approx(-250).epsilon(1e-9));
  REQUIRE(set_field(project, "geo.height_m=0"));
  CHECK(waypoint(project, 0).position_m.z == doctest::Approx(-350).epsilon(1e-9));
}

}  // namespace sigs
