// SPDX-License-Identifier: MIT
#include "dataset/encounter.h"

#include <doctest/doctest.h>

#include <cmath>
#include <random>

#include "base/pose.h"

using namespace sigs;

namespace {

double bearing_deg_of(const glm::dvec3& direction) {
  return deg_of_rad(std::atan2(direction.y, direction.x));
}

double elevation_deg_of(const glm::dvec3& direction) {
  return deg_of_rad(std::atan2(-direction.z, std::hypot(direction.x, direction.y)));
}

double turned_into_half_turns(double angle_deg) {
  return std::remainder(angle_deg, 360.0);
}

}  // namespace

TEST_CASE("an intruder from straight ahead that passes right, above, left and below does so") {
  struct Case {
    double angle_deg;
    glm::dvec3 miss_m;
  };
  for (const Case& c : {Case{0, {0, 50, 0}}, Case{90, {0, 0, -50}}, Case{180, {0, -50, 0}}, Case{-90, {0, 0, 50}}}) {
    const RelativeMotion motion = relative_motion({.miss_distance_m = 50,
                                                   .miss_angle_deg = c.angle_deg,
                                                   .closing_speed_mps = 40,
                                                   .time_of_closest_approach_s = 5});
    CHECK(motion.velocity_mps == glm::dvec3(-40, 0, 0));
    CHECK(glm::distance(motion.start_m, c.miss_m + glm::dvec3(200, 0, 0)) < 1e-12);
    CHECK(glm::distance(motion.at(5), c.miss_m) < 1e-12);
  }
}

TEST_CASE("an intruder from the right flies to the left, one from above down") {
  const RelativeMotion right = relative_motion({.bearing_deg = 90, .closing_speed_mps = 30});
  CHECK(right.velocity_mps == glm::dvec3(0, -30, 0));
  const RelativeMotion above = relative_motion({.elevation_deg = 90, .closing_speed_mps = 30});
  CHECK(above.velocity_mps == glm::dvec3(0, 0, 30));
}

TEST_CASE("miss distance, bearing, elevation, closing speed and time come back from the motion") {
  std::mt19937 random(5);
  const auto between = [&](double low, double high) {
    return low + (high - low) * double(random()) / double(std::mt19937::max());
  };
  for (int i = 0; i < 2000; ++i) {
    const Encounter wanted{.miss_distance_m = i % 10 == 0 ? 0 : between(0, 1e4),
                           .miss_angle_deg = between(-360, 360),
                           .bearing_deg = between(-360, 360),
                           .elevation_deg = between(-89, 89),
                           .closing_speed_mps = between(0.1, 400),
                           .time_of_closest_approach_s = i % 7 == 0 ? 0 : between(-100, 100)};
    const RelativeMotion motion = relative_motion(wanted);
    const double speed_mps = glm::length(motion.velocity_mps);
    const double closest_s = -glm::dot(motion.start_m, motion.velocity_mps) / (speed_mps * speed_mps);
    const glm::dvec3 came_from = -motion.velocity_mps;
    CHECK(std::abs(speed_mps - wanted.closing_speed_mps) < 1e-9);
    CHECK(std::abs(closest_s - wanted.time_of_closest_approach_s) * speed_mps < 1e-6);
    CHECK(std::abs(glm::length(motion.at(wanted.time_of_closest_approach_s)) - wanted.miss_distance_m) < 1e-6);
    CHECK(std::abs(turned_into_half_turns(bearing_deg_of(came_from) - wanted.bearing_deg)) < 1e-9);
    CHECK(std::abs(elevation_deg_of(came_from) - wanted.elevation_deg) < 1e-9);
  }
}

TEST_CASE("bearing and elevation are the intruder's direction long before, whatever the miss distance") {
  const Encounter encounter{.miss_distance_m = 500,
                            .miss_angle_deg = 30,
                            .bearing_deg = -40,
                            .elevation_deg = 12,
                            .closing_speed_mps = 100,
                            .time_of_closest_approach_s = 1e9};
  const glm::dvec3 seen = relative_motion(encounter).start_m;
  CHECK(std::abs(bearing_deg_of(seen) + 40) < 1e-6);
  CHECK(std::abs(elevation_deg_of(seen) - 12) < 1e-6);
}

TEST_CASE("of speed, time and range any two lead to the third") {
  const Encounter whole{
      .miss_distance_m = 30, .bearing_deg = 20, .closing_speed_mps = 8, .time_of_closest_approach_s = 5};
  CHECK(first_range_m(whole) == doctest::Approx(50).epsilon(1e-14));  // 30, 40, 50
  const Encounter open{.miss_distance_m = 30, .bearing_deg = 20};
  const auto by_time = timed_encounter(open, {.time_of_closest_approach_s = 5, .range_m = 50});
  const auto by_speed = timed_encounter(open, {.closing_speed_mps = 8, .range_m = 50});
  const auto directly = timed_encounter(open, {.closing_speed_mps = 8, .time_of_closest_approach_s = 5});
  REQUIRE((by_time && by_speed && directly));
  CHECK(by_time->closing_speed_mps == 8);
  CHECK(by_speed->time_of_closest_approach_s == 5);
  CHECK(directly->closing_speed_mps == 8);
}

TEST_CASE("a closest approach in the past leaves the same closing speed") {
  const auto encounter = timed_encounter({.miss_distance_m = 30}, {.time_of_closest_approach_s = -5, .range_m = 50});
  REQUIRE(encounter);
  CHECK(encounter->closing_speed_mps == 8);
  CHECK(glm::length(relative_motion(*encounter).start_m) == doctest::Approx(50).epsilon(1e-14));
}

TEST_CASE("an impossible encounter names the quantity that causes it") {
  const Encounter open{.miss_distance_m = 100};
  const auto reason = [&](const EncounterTiming& timing) {
    const auto encounter = timed_encounter(open, timing);
    REQUIRE(!encounter);
    return encounter.error();
  };
  CHECK(reason({.closing_speed_mps = 0, .time_of_closest_approach_s = 5}) ==
        "closing_speed_mps: 0 m/s cannot meet the miss distance of 100 m: the intruder never comes nearer");
  CHECK(reason({.closing_speed_mps = 50, .range_m = 99}) ==
        "range_m: the intruder starts 99 m away, nearer than the miss distance of 100 m");
  CHECK(reason({.time_of_closest_approach_s = 5, .range_m = 100}) ==
        "range_m: no closing speed leads from 100 m to the miss distance of 100 m in 5 s");
  CHECK(reason({.time_of_closest_approach_s = 0, .range_m = 200}) ==
        "range_m: no closing speed leads from 200 m to the miss distance of 100 m in 0 s");
}

TEST_CASE("an intruder may start exactly at its closest approach") {
  const auto encounter = timed_encounter({.miss_distance_m = 100}, {.closing_speed_mps = 50, .range_m = 100});
  REQUIRE(encounter);
  CHECK(encounter->time_of_closest_approach_s == 0);
}

TEST_CASE("the nearest distance is at the closest approach within the video, else at the nearer end") {
  const auto nearest = [](double time_s) {
    return min_range_m(
        relative_motion({.miss_distance_m = 30, .closing_speed_mps = 8, .time_of_closest_approach_s = time_s}), 10);
  };
  CHECK(nearest(5) == doctest::Approx(30).epsilon(1e-14));
  CHECK(nearest(15) == doctest::Approx(50).epsilon(1e-14));  // 5 s before it
  CHECK(nearest(-5) == doctest::Approx(50).epsilon(1e-14));
  CHECK(min_range_m({.start_m = {3, 4, 0}}, 10) == 5);  // no motion
}
