// SPDX-License-Identifier: MIT
#include "scene/flight.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "scene/opened_project.h"
#include "scene/sample_scenes.h"
#include "spline/directions.h"

using namespace sigs;
using namespace sigs::test;

namespace {

using std::numbers::pi;

SceneIntruder flying(const std::vector<TimedWaypoint>& waypoints, const TrajectorySettings& settings = {}) {
  return {"flying", nullptr, Trajectory::make(waypoints, settings).value()};
}

// A camera at world (0, 0, -1000) that flies along X, 25 frames a second.
Scene scene_of(SceneIntruder intruder, int frames, double camera_speed_mps = 0) {
  Scene scene{.camera = {*Lens::make({}), {640, 480}}};
  scene.motion = {{{1, 0, 0, 0}, {0, 0, -1000}}, camera_speed_mps};
  scene.footage = {.size_px = {640, 480}, .frame_interval_s = 0.04};
  for (int frame = 0; frame < frames; ++frame) scene.footage.times_s.push_back(frame / 25.0);
  scene.last_frame = frames - 1;
  scene.intruders.push_back(std::move(intruder));
  return scene;
}

// Right turns on a circle; so many waypoints that the spline is the circle.
std::vector<TimedWaypoint> circle(double radius_m, double speed_mps, double seconds) {
  std::vector<TimedWaypoint> waypoints;
  for (double t = 0; t <= seconds; t += 0.05) {
    const double angle = speed_mps * t / radius_m;
    waypoints.push_back({t, {radius_m * std::sin(angle), radius_m * (1 - std::cos(angle)), -1000}});
  }
  return waypoints;
}

std::vector<FlightFlag> of_kind(const std::vector<FlightFlag>& flags, FlightFault fault) {
  std::vector<FlightFlag> found;
  std::copy_if(flags.begin(), flags.end(), std::back_inserter(found),
               [&](const FlightFlag& flag) { return flag.fault == fault; });
  return found;
}

}  // namespace

TEST_CASE("a straight climb has its speed, its climb rate and the load of its slope") {
  const FlightState state = flight_at(flying({{0, {0, 0, -1000}}, {10, {800, 0, -1600}}}), 5);
  CHECK(state.position_m.z == doctest::Approx(-1300));
  CHECK(state.speed_mps == doctest::Approx(100));
  CHECK(state.climb_rate_mps == doctest::Approx(60));  // up is positive
  CHECK(state.load_factor == doctest::Approx(0.8));    // cos of the climb's angle
  CHECK(std::abs(state.bank_rad) < 1e-9);
  CHECK(flight_at(flying({{0, {0, 0, -1000}}, {10, {800, 0, -400}}}), 5).climb_rate_mps == doctest::Approx(-60));
}

TEST_CASE("a level turn has the load factor one over the cosine of its bank") {
  for (const double bank_deg : {15.0, 40.0, 55.0}) {
    const double bank_rad = bank_deg * pi / 180;
    const double speed_mps = 70;
    const double radius_m = speed_mps * speed_mps / (kGravity_mps2 * std::tan(bank_rad));
    const FlightState state = flight_at(flying(circle(radius_m, speed_mps, 20)), 10);
    CHECK(state.bank_rad == doctest::Approx(bank_rad).epsilon(1e-3));  // the attitude is tabulated
    CHECK(state.load_factor == doctest::Approx(1 / std::cos(bank_rad)).epsilon(1e-3));
    CHECK(std::abs(state.side_load_factor) < 2e-3);
  }
}

TEST_CASE("a turn with level wings has a sideways load factor") {
  const double radius_m = 500;
  const double speed_mps = 70;
  const FlightState state = flight_at(flying(circle(radius_m, speed_mps, 20), {.bank = Bank::level}), 10);
  CHECK(state.load_factor == doctest::Approx(1).epsilon(1e-3));
  CHECK(state.side_load_factor ==
        doctest::Approx(speed_mps * speed_mps / radius_m / kGravity_mps2).epsilon(2e-3));  // to the right
}

TEST_CASE("free fall has a load factor of zero") {
  std::vector<TimedWaypoint> parabola;
  for (double t = 0; t <= 8; t += 0.05)
    parabola.push_back({t, {90 * t, 0, -2000 - 30 * t + 0.5 * kGravity_mps2 * t * t}});
  const FlightState state = flight_at(flying(parabola), 4);
  CHECK(std::abs(state.load_factor) < 1e-3);
}

TEST_CASE("hovering has a load factor of one") {
  const FlightState state = flight_at(flying({{0, {10, 20, -1000}}}), 3);
  CHECK(state.speed_mps == 0);
  CHECK(state.load_factor == doctest::Approx(1));
}

TEST_CASE("the closest approach of two straight flights is that of the closed form") {
  for (const double camera_speed_mps : {0.0, 22.0, -40.0})
    for (const double y_m : {-300.0, -1.0, 1e5}) {
      const glm::dvec3 from_m(400, y_m, -1080);
      const glm::dvec3 velocity_mps(-55, 31, 4);
      const Scene scene = scene_of(flying({{0, from_m}, {10, from_m + 10.0 * velocity_mps}}), 251, camera_speed_mps);
      const glm::dvec3 apart_m = from_m - glm::dvec3(0, 0, -1000);
      const glm::dvec3 relative_mps = velocity_mps - glm::dvec3(camera_speed_mps, 0, 0);
      const double time_s =
          std::clamp(-glm::dot(apart_m, relative_mps) / glm::dot(relative_mps, relative_mps), 0.0, 10.0);
      const ClosestApproach closest = closest_approach(scene, 0);
      CHECK(closest.time_s == doctest::Approx(time_s).epsilon(1e-6));
      CHECK(closest.frame == doctest::Approx(25 * time_s).epsilon(1e-6));
      CHECK(closest.distance_m == doctest::Approx(glm::length(apart_m + time_s * relative_mps)).epsilon(1e-9));
    }
}

TEST_CASE("a collision between two frames is found") {
  const glm::dvec3 velocity_mps(-300, 0, 0);
  const double hit_s = 2.013;
  const glm::dvec3 from_m = glm::dvec3(0, 0, -1000) - hit_s * velocity_mps;
  const ClosestApproach closest =
      closest_approach(scene_of(flying({{0, from_m}, {4, from_m + 4.0 * velocity_mps}}), 101), 0);
  CHECK(closest.time_s == doctest::Approx(hit_s).epsilon(1e-6));
  CHECK(closest.distance_m < 1e-4);
}

TEST_CASE("of equal distances the earliest is given") {
  CHECK(closest_approach(scene_of(flying({{0, {50, 0, -1000}}}), 100), 0).frame == 0);
  // Round the camera: always as far, but for rounding.
  std::vector<TimedWaypoint> there_and_back;
  for (int i = 0; i <= 4; ++i) there_and_back.push_back({double(i), {i % 2 == 0 ? 200 : 100, 0, -1000}});
  const ClosestApproach closest = closest_approach(scene_of(flying(there_and_back), 101), 0);
  CHECK(closest.time_s == doctest::Approx(1).epsilon(0.1));
}

TEST_CASE("the lowest of several minima counts, and only within the range") {
  std::vector<TimedWaypoint> waypoints;
  const double near_m[] = {300, 120, 300, 90, 300, 60, 300};
  for (int i = 0; i < 7; ++i) waypoints.push_back({2.0 * i, {near_m[i], 0, -1000}});
  Scene scene = scene_of(flying(waypoints), 301);
  CHECK(closest_approach(scene, 0).time_s == doctest::Approx(10).epsilon(0.02));
  scene.last_frame = 200;
  CHECK(closest_approach(scene, 0).time_s == doctest::Approx(6).epsilon(0.02));
  scene.first_frame = 200;
  CHECK(closest_approach(scene, 0).frame == 200);
}

TEST_CASE("a long flight is searched in a bounded number of steps") {
  const glm::dvec3 from_m(20'000, 100, -1000);
  const ClosestApproach closest =
      closest_approach(scene_of(flying({{0, from_m}, {4000, from_m + glm::dvec3(-40'000, 0, 0)}}), 100'000), 0);
  CHECK(closest.time_s == doctest::Approx(2000).epsilon(1e-6));
  CHECK(closest.distance_m == doctest::Approx(100));
}

TEST_CASE("limits grow with the aircraft's length, and an invalid length counts as small") {
  CHECK(limits_of(10).highest_load_factor == 3.8);
  CHECK(limits_of(18).lowest_load_factor == -1.52);
  CHECK(limits_of(37).highest_load_factor == 2.5);
  CHECK(limits_of(37).lowest_load_factor == -1);
  CHECK(limits_of(37).highest_speed_mps > limits_of(10).highest_speed_mps);
  CHECK(limits_of(std::nan("")).highest_load_factor == 3.8);
}

TEST_CASE("a nine g turn is flagged where it is flown") {
  // Straight along X, from 2 s to 4 s on a circle of 9 g, straight on.
  const double speed_mps = 100;
  const double turn_mps2 = kGravity_mps2 * std::sqrt(80.0);  // with gravity across: 9 g
  const double radius_m = speed_mps * speed_mps / turn_mps2;
  std::vector<TimedWaypoint> waypoints;
  const double turned_rad = speed_mps * 2 / radius_m;
  const glm::dvec3 end_m(200 + radius_m * std::sin(turned_rad), radius_m * (1 - std::cos(turned_rad)), -1000);
  for (double t = 0; t < 6.01; t += 0.05) {
    const double angle = speed_mps * (t - 2) / radius_m;
    if (t < 2)
      waypoints.push_back({t, {speed_mps * t, 0, -1000}});
    else if (t < 4)
      waypoints.push_back({t, {200 + radius_m * std::sin(angle), radius_m * (1 - std::cos(angle)), -1000}});
    else
      waypoints.push_back({t, end_m + speed_mps * (t - 4) * glm::dvec3(std::cos(turned_rad), std::sin(turned_rad), 0)});
  }
  for (const Bank bank : {Bank::coordinated, Bank::level}) {
    const Scene scene = scene_of(flying(waypoints, {.bank = bank}), 151);
    const std::vector<FlightFlag> flags = flight_flags(scene, 0);
    REQUIRE(flags.size() == 1);
    CHECK(flags[0].fault == FlightFault::load);
    CHECK(std::abs(flags[0].first_frame - 50) < 3);  // the spline begins to bend a little before
    CHECK(std::abs(flags[0].last_frame - 100) < 3);
    CHECK(flags[0].worst > 8.8);
    CHECK(flags[0].worst < 13);  // the spline overshoots where the curvature jumps
    CHECK(flags[0].limit == 3.8);
  }
}

TEST_CASE("too fast, too steep, under ground: each is flagged for as long as it lasts") {
  // Down through the ground at 5 s, 320 m/s over all.
  const glm::dvec3 velocity_mps(310, 0, 80);
  const Scene scene = scene_of(flying({{0, -5.0 * velocity_mps}, {10, 5.0 * velocity_mps}}), 251);
  const std::vector<FlightFlag> flags = flight_flags(scene, 0);
  REQUIRE(flags.size() == 3);
  const std::vector<FlightFlag> speed = of_kind(flags, FlightFault::speed);
  REQUIRE(speed.size() == 1);
  CHECK(speed[0].worst == doctest::Approx(glm::length(velocity_mps)));
  CHECK(speed[0].first_frame == 0);
  CHECK(speed[0].last_frame == 250);
  const std::vector<FlightFlag> climb = of_kind(flags, FlightFault::climb);
  REQUIRE(climb.size() == 1);
  CHECK(climb[0].worst == doctest::Approx(-80));
  CHECK(climb[0].limit == -limits_of(0).highest_climb_mps);
  const std::vector<FlightFlag> under = of_kind(flags, FlightFault::underground);
  REQUIRE(under.size() == 1);
  CHECK(under[0].first_frame == doctest::Approx(125).epsilon(0.005));
  CHECK(under[0].worst == doctest::Approx(400));
  CHECK(flags.back().fault == FlightFault::underground);  // by first frame
}

TEST_CASE("a large aircraft is flagged where a small one is not") {
  const double radius_m = 70.0 * 70.0 / (kGravity_mps2 * std::sqrt(8.0));  // 3 g
  Scene scene = scene_of(flying(circle(radius_m, 70, 10), {.bank_limit_rad = 1.4}), 240);
  const auto inner = [](std::vector<FlightFlag> flags) {
    return std::any_of(flags.begin(), flags.end(),
                       [](const FlightFlag& flag) { return flag.first_frame < 100 && flag.last_frame > 110; });
  };
  CHECK_FALSE(inner(flight_flags(scene, 0)));
  Model large;
  large.mesh.low_m.x = -20;
  large.mesh.high_m.x = 20;
  scene.models.push_back(std::make_shared<const Model>(large));
  scene.intruders[0].model = scene.models[0].get();
  CHECK(inner(flight_flags(scene, 0)));
}

TEST_CASE("the samples fly within their limits") {
  for (const char* const name : kSampleProjects) {
    const Scene scene = open_scene(sample_project(name), sample_footage()).value();
    for (std::size_t i = 0; i < scene.intruders.size(); ++i)
      for (const FlightFlag& flag : flight_flags(scene, static_cast<int>(i)))
        FAIL_CHECK(std::string(name), " ", i, ": ", flag.text(), " from ", flag.first_frame, " to ", flag.last_frame);
  }
}

TEST_CASE("a range of one frame can be checked") {
  Scene scene = scene_of(flying({{0, {0, 0, 5}}}), 1);
  const std::vector<FlightFlag> flags = flight_flags(scene, 0);
  REQUIRE(flags.size() == 1);
  CHECK(flags[0].first_frame == 0);
  CHECK(flags[0].last_frame == 0);
  CHECK(flags[0].text() == "5 m below the ground");
}

TEST_CASE("flags give value and limit, rounded so that the excess is visible") {
  using F = FlightFault;
  CHECK(FlightFlag{F::load, 0, 1, 5.2, 2.5}.text() == "load factor 5.2, at most 2.5 for an aircraft of this size");
  CHECK(FlightFlag{F::load, 0, 1, -2, -1.52}.text() == "load factor -2, at least -1.52 for an aircraft of this size");
  CHECK(FlightFlag{F::load, 0, 1, 2.5001, 2.5}.text() == "load factor 2.51, at most 2.5 for an aircraft of this size");
  CHECK(FlightFlag{F::climb, 0, 1, -80, -30}.text() == "descent 80 m/s, at most 30 m/s for an aircraft of this size");
  CHECK(FlightFlag{F::speed, 0, 1, 320.155, 250}.text() ==
        "speed 320.16 m/s, at most 250 m/s for an aircraft of this size");
}
