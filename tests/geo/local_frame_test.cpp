// SPDX-License-Identifier: MIT
#include "geo/geodetic.h"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <limits>
#include <sstream>
#include <vector>

#include "base/pose.h"
#include "support/process.h"
#include "support/test_data.h"

using namespace sigs;
using namespace sigs::test;

namespace {

bool has_cart_convert() {
  if (run_command("command -v CartConvert").status == 0) return true;
  say_skipped("needs CartConvert (package geographiclib-tools)");
  return false;
}

// What CartConvert answers to lines of three numbers, for a frame of east, north and up at an origin.
std::vector<glm::dvec3> answers_of_cart_convert(const GeodeticPosition& origin, const std::string& option,
                                                const std::vector<glm::dvec3>& questions) {
  std::string input;
  for (const glm::dvec3& q : questions) input += fmt::format("{:.15f} {:.15f} {:.9f}\n", q.x, q.y, q.z);
  const Run run = run_command(fmt::format("CartConvert {} -p 9 -l {:.15f} {:.15f} {:.9f} <<END\n{}END", option,
                                          origin.latitude_deg, origin.longitude_deg, origin.height_m, input));
  REQUIRE_MESSAGE(run.status == 0, run.err);
  std::istringstream out(run.out);
  std::vector<glm::dvec3> answers(questions.size());
  for (glm::dvec3& answer : answers) REQUIRE(static_cast<bool>(out >> answer.x >> answer.y >> answer.z));
  return answers;
}

std::vector<GeodeticPosition> places_all_over_the_earth() {
  std::vector<GeodeticPosition> places;
  for (const double latitude_deg : {-90.0, -89.999, -45.5, -1e-7, 0.0, 33.126, 60.25, 89.9999999, 90.0})
    for (const double longitude_deg : {-180.0, -179.9999, -117.3315, 0.0, 8.55, 179.9999, 180.0})
      for (const double height_m : {-400.0, 0.0, 12000.0, 40000.0, 1e7})
        places.push_back({latitude_deg, longitude_deg, height_m});
  return places;
}

const std::vector<GeodeticPosition> kOrigins{{33.126, -117.3315, 15}, {0, 0, 0},      {90, 0, 100},
                                             {-90, 45, 2800},         {0, 180, -400}, {52.2, -180, 40},
                                             {-20.25, 149.02, 40000}};

}  // namespace

TEST_CASE("X points along the heading, Y to its right and Z down") {
  const GeodeticPosition origin{33.126, -117.3315, 15};
  const LocalFrame east(origin, rad_of_deg(90));
  CHECK(glm::length(east.world_of(origin)) < 1e-8);
  const glm::dvec3 north = east.world_of({33.127, -117.3315, 15});
  CHECK(north.y < -110);
  CHECK(std::abs(north.x) < 1e-6);
  CHECK(east.world_of({33.126, -117.3315, 25}).z == doctest::Approx(-10).epsilon(1e-9));
}

TEST_CASE("a place comes back from the world") {
  const LocalFrame frame({-20.25, 149.02, 300}, 1);
  const GeodeticPosition place{-20.3, 149.1, 1200};
  const GeodeticPosition back = frame.place_of(frame.world_of(place));
  CHECK(back.latitude_deg == doctest::Approx(place.latitude_deg).epsilon(1e-13));
  CHECK(back.longitude_deg == doctest::Approx(place.longitude_deg).epsilon(1e-13));
  CHECK(back.height_m == doctest::Approx(place.height_m).epsilon(1e-10));
}

TEST_CASE("points of the world are those of CartConvert, all over the Earth") {
  if (!has_cart_convert()) return;
  const std::vector<GeodeticPosition> places = places_all_over_the_earth();
  std::vector<glm::dvec3> questions;
  for (const GeodeticPosition& place : places)
    questions.emplace_back(place.latitude_deg, place.longitude_deg, place.height_m);
  double worst_m = 0;
  for (const GeodeticPosition& origin : kOrigins) {
    const std::vector<glm::dvec3> enu = answers_of_cart_convert(origin, "", questions);
    for (const double heading_rad : {0.0, 2.5, -1.0}) {
      const LocalFrame frame(origin, heading_rad);
      for (std::size_t i = 0; i < places.size(); ++i) {
        const glm::dvec3 ned = frame.ned_of_world(frame.world_of(places[i]));
        worst_m = std::max(worst_m, glm::distance(glm::dvec3(ned.y, ned.x, -ned.z), enu[i]));
      }
    }
  }
  MESSAGE("largest difference " << worst_m << " m");
  CHECK(worst_m < 1e-6);  // the numbers are up to 3e7 m, of which a double has 4e-9 m
}

TEST_CASE("places of points of the world are those of CartConvert, up to 10,000 km away") {
  if (!has_cart_convert()) return;
  std::vector<glm::dvec3> enu;
  for (const double east_m : {-1e7, -3000.0, 0.0, 0.001, 1e5})
    for (const double north_m : {-1e7, -0.5, 0.0, 2e4, 1e6})
      for (const double up_m : {-300.0, 0.0, 40000.0, 1e7}) enu.emplace_back(east_m, north_m, up_m);
  double worst_m = 0;
  for (const GeodeticPosition& origin : kOrigins) {
    const LocalFrame frame(origin, 0.7);
    const std::vector<glm::dvec3> answers = answers_of_cart_convert(origin, "-r", enu);
    for (std::size_t i = 0; i < enu.size(); ++i) {
      const GeodeticPosition place = frame.place_of(frame.world_of_ned({enu[i].y, enu[i].x, -enu[i].z}));
      CHECK(check_place({place.latitude_deg, place.longitude_deg, 0}).has_value());
      // As distances, since a longitude near a pole means little.
      const glm::dvec3 theirs = frame.world_of({answers[i].x, answers[i].y, answers[i].z});
      worst_m = std::max(worst_m, glm::distance(theirs, frame.world_of(place)));
    }
  }
  MESSAGE("largest difference " << worst_m << " m");
  CHECK(worst_m < 1e-6);
}

TEST_CASE("the world parts from the ellipsoid by 0.08 m at 1 km and 7.8 to 7.9 m at 10 km") {
  // The drop of a sphere with the Earth's radii of curvature: distance^2 / (2 radius).
  for (const double latitude_deg : {0.0, 45.0, -89.0})
    for (const double heading_deg : {0.0, 90.0}) {
      const LocalFrame frame({latitude_deg, 10, 0}, rad_of_deg(heading_deg));
      const double height_at_1_km_m = frame.place_of({1000, 0, 0}).height_m;
      const double height_at_10_km_m = frame.place_of({10000, 0, 0}).height_m;
      CHECK(height_at_1_km_m == doctest::Approx(0.0785).epsilon(0.01));  // the radius varies by 1 %
      CHECK(height_at_10_km_m == doctest::Approx(7.85).epsilon(0.01));
    }
}

TEST_CASE("a place out of range or not finite is refused with the number") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  for (const GeodeticPosition& place : places_all_over_the_earth()) CHECK(check_place(place).has_value());
  for (const double latitude_deg : {nan, infinity, -infinity, 90.0000001, -1000.0}) {
    const Result<void> checked = check_place({latitude_deg, 0, 0});
    REQUIRE_FALSE(checked.has_value());
    CHECK(checked.error().what.find("latitude") != std::string::npos);
  }
  for (const double longitude_deg : {nan, infinity, 180.0000001, -1000.0})
    CHECK_FALSE(check_place({0, longitude_deg, 0}).has_value());
  for (const double height_m : {nan, infinity, -13e3, 1.1e7}) CHECK_FALSE(check_place({0, 0, height_m}).has_value());
  // Why they are refused.
  CHECK(std::isnan(LocalFrame({10, 10, 0}, 0).world_of({90.5, 0, 0}).x));
}
