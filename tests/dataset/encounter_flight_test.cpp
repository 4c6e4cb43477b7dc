// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <cmath>
#include <random>

#include "base/pose.h"
#include "dataset/flight_contexts.h"
#include "dataset/flight_plan.h"

using namespace sigs;
using namespace sigs::test;

namespace {

// The properties of a flown path, measured from its positions alone.
struct Found {
  double miss_distance_m = 0;
  double time_s = 0;
  double closing_speed_mps = 0;
  glm::dvec3 came_from{0, 0, 0};
};

Found found_by_search(const FlightContext& context, const PlannedFlight& flight) {
  const Trajectory trajectory = trajectory_of(context, flight);
  const auto at = [&](double time_s) { return relative_position_m(context, trajectory, time_s); };
  // The distance falls before the closest approach and grows after it.
  const auto falls = [&](double time_s) { return glm::dot(at(time_s), at(time_s + 1) - at(time_s - 1)) < 0; };
  double low_s = -1e4, high_s = 1e4;
  for (int i = 0; i < 100; ++i) {
    const double middle_s = (low_s + high_s) / 2;
    (falls(middle_s) ? low_s : high_s) = middle_s;
  }
  const glm::dvec3 apart_m = at(low_s + 500) - at(low_s - 500);
  return {glm::length(at(low_s)), low_s, glm::length(apart_m) / 1000, -apart_m};
}

struct World {
  Camera lens = example_lenses().front().camera;
  FootageShape footage = footage_of(190, 0.01);

  [[nodiscard]] FlightContext context(const CameraSettings& camera, FrameRange frames = {0, 189}) const {
    return {.camera = camera, .lens = lens, .footage = footage, .frames = frames};
  }
};

const CameraSettings kHigh{.position_m = {12, -7, -3e5}, .pitch_deg = 5, .yaw_deg = 30, .speed_mps = 22};

std::string reason(const std::map<std::string, double>& given, const FlightContext& context) {
  const auto flight = planned_flight(FlightKind::encounter, values_with(FlightKind::encounter, given), context);
  REQUIRE(!flight);
  return flight.error();
}

}  // namespace

TEST_CASE("a flown encounter has the miss distance, time, speed, bearing and elevation that were asked for") {
  const World world;
  std::mt19937 random(11);
  const auto between = [&](double low, double high) {
    return low + (high - low) * double(random()) / double(std::mt19937::max());
  };
  for (int i = 0; i < 400; ++i) {
    const int first = i % 3 == 0 ? 0 : i % 150;
    const FlightContext context = world.context(kHigh, {first, first + 1 + i % 39});
    const double time_s = i % 5 == 0 ? 0 : between(-60, 60);
    const double miss_m = i % 4 == 0 ? 0 : i % 4 == 1 ? 1e5 : between(0, 2000);
    const std::map<std::string, double> given{{"miss_distance_m", miss_m},
                                              {"miss_angle_deg", between(-360, 360)},
                                              {"bearing_deg", between(-180, 180)},
                                              {"elevation_deg", between(-80, 80)},
                                              {"closing_speed_mps", between(1, 400)},
                                              {"time_of_closest_approach_s", time_s}};
    const auto flight = planned_flight(FlightKind::encounter, values_with(FlightKind::encounter, given), context);
    REQUIRE(flight);
    const Found found = found_by_search(context, *flight);
    const double first_s = time_of_frame_s(world.footage, first);
    // 1e-10 m of rounding, carried from one frame over a minute: 1e-7 m.
    CHECK(std::abs(found.miss_distance_m - miss_m) < 1e-6);
    CHECK(std::abs(found.time_s - first_s - time_s) * given.at("closing_speed_mps") < 1e-6);
    CHECK(std::abs(found.closing_speed_mps - given.at("closing_speed_mps")) < 1e-6);
    CHECK(std::abs(std::remainder(
              deg_of_rad(std::atan2(found.came_from.y, found.came_from.x)) - given.at("bearing_deg"), 360.0)) < 1e-6);
    CHECK(std::abs(deg_of_rad(std::asin(-found.came_from.z / glm::length(found.came_from))) -
                   given.at("elevation_deg")) < 1e-6);
  }
}

TEST_CASE("over a whole clip at the usual height an encounter is exact to a micrometre") {
  const World world;
  const FlightContext context = world.context({.speed_mps = 22});
  for (const double miss_m : {0.0, 3.0, 150.0, 1e5})
    for (const double time_s : {-30.0, 0.0, 4.0, 7.56, 100.0}) {
      const auto flight = planned_flight(FlightKind::encounter,
                                         values_with(FlightKind::encounter, {{"miss_distance_m", miss_m},
                                                                             {"bearing_deg", -25},
                                                                             {"closing_speed_mps", 75},
                                                                             {"time_of_closest_approach_s", time_s}}),
                                         context);
      REQUIRE(flight);
      const Found found = found_by_search(context, *flight);
      CHECK(std::abs(found.miss_distance_m - miss_m) < 1e-6);
      CHECK(std::abs(found.time_s - time_s) < 1e-6);
      CHECK(std::abs(found.closing_speed_mps - 75) < 1e-6);
      CHECK(std::abs(deg_of_rad(std::atan2(found.came_from.y, found.came_from.x)) + 25) < 1e-6);
    }
}

TEST_CASE("without time and range an encounter is closest in the last frame") {
  const World world;
  const FlightContext context = world.context({.speed_mps = 22}, {10, 60});
  const auto flight =
      planned_flight(FlightKind::encounter,
                     values_with(FlightKind::encounter, {{"miss_distance_m", 40}, {"closing_speed_mps", 60}}), context);
  REQUIRE(flight);
  const Trajectory trajectory = trajectory_of(context, *flight);
  const double last_s = time_of_frame_s(world.footage, 60);
  CHECK(glm::length(relative_position_m(context, trajectory, last_s)) == doctest::Approx(40).epsilon(1e-12));
  CHECK(flight->derived.at("nearest_m") == doctest::Approx(40).epsilon(1e-12));
  CHECK(found_by_search(context, *flight).time_s == doctest::Approx(last_s).epsilon(1e-9));
}

TEST_CASE("a range is the distance in the first frame") {
  const World world;
  const FlightContext context = world.context({.speed_mps = 22}, {10, 60});
  const auto flight = planned_flight(
      FlightKind::encounter,
      values_with(FlightKind::encounter, {{"miss_distance_m", 40}, {"closing_speed_mps", 60}, {"range_m", 500}}),
      context);
  REQUIRE(flight);
  const double first_s = time_of_frame_s(world.footage, 10);
  CHECK(glm::length(relative_position_m(context, trajectory_of(context, *flight), first_s)) ==
        doctest::Approx(500).epsilon(1e-12));
  CHECK(flight->derived.at("range_m") == doctest::Approx(500).epsilon(1e-12));
  CHECK(flight->derived.at("time_of_closest_approach_s") ==
        doctest::Approx(std::sqrt(500.0 * 500 - 40 * 40) / 60).epsilon(1e-12));
}

TEST_CASE("the intruder's own speed is that of the relative motion on top of the camera's") {
  const World world;
  const auto flight = planned_flight(
      FlightKind::encounter, values_with(FlightKind::encounter, {{"miss_distance_m", 0}, {"closing_speed_mps", 62}}),
      world.context({.speed_mps = 22}));
  REQUIRE(flight);
  CHECK(flight->derived.at("speed_mps") == 40);  // from ahead, towards the camera
}

TEST_CASE("a video of one frame has an intruder that moves") {
  const World world;
  for (const int frame : {0, 30, 189}) {
    const FlightContext context = world.context({.speed_mps = 22}, {frame, frame});
    const auto flight = planned_flight(
        FlightKind::encounter,
        values_with(FlightKind::encounter,
                    {{"miss_distance_m", 40}, {"closing_speed_mps", 60}, {"time_of_closest_approach_s", 3}}),
        context);
    REQUIRE(flight);
    CHECK(*flight->waypoints[0].frame == frame);
    const Found found = found_by_search(context, *flight);
    CHECK(found.miss_distance_m == doctest::Approx(40).epsilon(1e-6));
    CHECK(found.closing_speed_mps == doctest::Approx(60).epsilon(1e-6));
  }
}

TEST_CASE("each impossible encounter has its own reason") {
  const World world;
  FlightContext context = world.context({.speed_mps = 22});
  CHECK(reason({{"miss_distance_m", 100}, {"closing_speed_mps", 0}}, context) ==
        "closing_speed_mps: 0 m/s cannot meet the miss distance of 100 m: the intruder never comes nearer");
  CHECK(reason({{"miss_distance_m", -1}, {"closing_speed_mps", 50}}, context) ==
        "miss_distance_m: is -1; it must lie between 0 and 1e7");
  CHECK(reason({{"miss_distance_m", 0}, {"elevation_deg", 91}, {"closing_speed_mps", 50}}, context) ==
        "elevation_deg: is 91; it must lie between -90 and 90");
  CHECK(reason({{"miss_distance_m", std::nan("")}, {"closing_speed_mps", 50}}, context)
            .starts_with("miss_distance_m: is "));
  CHECK(reason({{"miss_distance_m", 100}, {"closing_speed_mps", 1e4}, {"time_of_closest_approach_s", 1e6}}, context)
            .find("farther than 1e8 m") != std::string::npos);
  context.speed_limits_mps = Span{25, 84};
  CHECK(reason({{"miss_distance_m", 100}, {"closing_speed_mps", 120}}, context) ==
        "speed_mps: the intruder would have to fly 98 m/s; its aircraft flies 25 to 84; change closing_speed_mps or "
        "bearing_deg, or the aircraft's speed_limits_mps");
  CHECK(reason({{"miss_distance_m", 100}, {"closing_speed_mps", 30}}, context) ==
        "speed_mps: the intruder would have to fly 8 m/s; its aircraft flies 25 to 84; change closing_speed_mps or "
        "bearing_deg, or the aircraft's speed_limits_mps");
}

TEST_CASE("an intruder may touch the ground in its lowest frame and not go below") {
  const World world;
  const FlightContext context = world.context({.position_m = {0, 0, -150}, .speed_mps = 22});
  const auto passing_below = [&](double miss_m) {
    return planned_flight(
        FlightKind::encounter,
        values_with(FlightKind::encounter,
                    {{"miss_distance_m", miss_m}, {"miss_angle_deg", -90}, {"closing_speed_mps", 60}}),
        context);
  };
  CHECK(passing_below(150));
  REQUIRE(!passing_below(150.5));
  CHECK(passing_below(150.5).error() ==
        "elevation_deg, miss_angle_deg: the intruder is underground in frame 0, 0.5 m below z = 0");
  // Climbing out of the ground: below it in the first frame alone.
  CHECK(reason({{"miss_distance_m", 0}, {"elevation_deg", -30}, {"closing_speed_mps", 60}}, context)
            .find("underground in frame 0") != std::string::npos);
}
