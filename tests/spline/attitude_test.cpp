// SPDX-License-Identifier: MIT

#include <doctest/doctest.h>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/pose.h"
#include "flights.h"
#include "spline/trajectory.h"

namespace sigs {

using namespace test;

namespace {

constexpr double kStandardGravity_mps2 = 9.80665;

glm::dvec3 nose_in_world(const Trajectory& trajectory, double time_s) {
  return trajectory.world_from_body(time_s).rotation * glm::dvec3(1, 0, 0);
}

glm::dvec3 up_in_world(const Trajectory& trajectory, double time_s) {
  return trajectory.world_from_body(time_s).rotation * glm::dvec3(0, 0, -1);
}

Attitude attitude_at(const Trajectory& trajectory, double time_s) {
  return attitude_of(trajectory.world_from_body(time_s).rotation);
}

}  // namespace

TEST_CASE("a level turn is banked by atan of v squared over R g to the side it turns") {
  for (const int side : {1, -1})
    for (const double speed_mps : {20.0, 60.0, 90.0})
      for (const Timing timing : {Timing::frames, Timing::constant_speed}) {
        const double radius_m = 500;
        const auto waypoints = circle(radius_m, speed_mps, 1.25, side);
        const Trajectory trajectory = trajectory_through(waypoints, {.timing = timing});
        const double expected_rad = side * std::atan(speed_mps * speed_mps / (radius_m * kStandardGravity_mps2));
        for (double share = 0.2; share < 0.8; share += 0.01) {
          const Attitude attitude = attitude_at(trajectory, share * waypoints.back().time_s);
          CHECK(std::abs(attitude.roll_rad - expected_rad) < 1e-3);  // waypoints 5 degrees apart: v^2/R to 1e-3
          CHECK(std::abs(attitude.pitch_rad) < 1e-6);
        }
      }
}

TEST_CASE("the bank limit holds in a turn that would need more bank") {
  const auto waypoints = circle(150, 90, 1.25, 1);  // asks for 80 degrees
  for (const double limit_deg : {0.0, 30.0, 60.0}) {
    const Trajectory trajectory = trajectory_through(waypoints, {.bank_limit_rad = rad_of_deg(limit_deg)});
    for (double share = -0.5; share < 1.5; share += 0.01)
      CHECK(std::abs(attitude_at(trajectory, share * waypoints.back().time_s).roll_rad) < rad_of_deg(limit_deg) + 1e-6);
    CHECK(std::abs(attitude_at(trajectory, 0.5 * waypoints.back().time_s).roll_rad - rad_of_deg(limit_deg)) < 1e-6);
  }
}

TEST_CASE("the bank limit holds in wild flights that never get steep") {
  for (unsigned seed = 1; seed <= 5; ++seed) {
    auto waypoints = wild(15, seed);
    for (TimedWaypoint& w : waypoints) w.position_m.z *= 0.02;
    const Trajectory trajectory = trajectory_through(waypoints, {.timing = Timing::constant_speed});
    for (double time_s = -1; time_s < waypoints.back().time_s + 1; time_s += 0.01) {
      const Attitude attitude = attitude_at(trajectory, time_s);
      if (std::abs(attitude.pitch_rad) < rad_of_deg(45))
        CHECK(std::abs(attitude.roll_rad) < rad_of_deg(62));  // the smoothing may exceed the limit a little
    }
  }
}

TEST_CASE("a fast loop is flown upside down at its top and upright before and after") {
  const auto waypoints = loop(80, 60);
  for (const Timing timing : {Timing::frames, Timing::constant_speed}) {
    const Trajectory trajectory = trajectory_through(waypoints, {.timing = timing});
    double top_s = 0;
    for (double time_s = 0; time_s < waypoints.back().time_s; time_s += 0.01)
      if (trajectory.position_m(time_s).z < trajectory.position_m(top_s).z) top_s = time_s;
    CHECK(up_in_world(trajectory, top_s).z > 0.99);
    CHECK(up_in_world(trajectory, 1).z < -0.99);
    CHECK(up_in_world(trajectory, waypoints.back().time_s - 1).z < -0.99);
  }
}

TEST_CASE("a path that curves sharply down is pushed over upright and not flown inverted") {
  std::vector<TimedWaypoint> hill;
  for (int i = 0; i <= 10; ++i) hill.push_back({i * 1.0, {60.0 * i, 0, -15 * (i % 2)}});
  std::vector<TimedWaypoint> all_the_way;
  for (int i = 0; i <= 12; ++i) all_the_way.push_back({i * 0.5, {50.0 * i, 0, 10 * std::pow(0.5 * i - 3, 2)}});
  for (const auto& waypoints : {hill, all_the_way}) {
    const Trajectory trajectory = trajectory_through(waypoints);
    CHECK(trajectory.acceleration_mps2(5).z > 1.5 * kStandardGravity_mps2);
    for (double time_s = 0; time_s < waypoints.back().time_s; time_s += 0.01)
      CHECK(std::abs(attitude_at(trajectory, time_s).roll_rad) < 1e-6);
  }
}

TEST_CASE("wings are level on request") {
  const auto waypoints = circle(300, 60, 1.25, -1);
  const Trajectory trajectory = trajectory_through(waypoints, {.bank = Bank::level});
  for (double time_s = -1; time_s < waypoints.back().time_s + 1; time_s += 0.05)
    CHECK(std::abs(attitude_at(trajectory, time_s).roll_rad) < 1e-6);
}

TEST_CASE("no force acts sideways in coordinated flight under the limit") {
  const auto waypoints = circle(700, 60, 1.25, 1);
  auto climbing = waypoints;
  for (TimedWaypoint& w : climbing) w.position_m.z -= 15 * w.time_s;
  const Trajectory trajectory = trajectory_through(climbing);
  for (double share = 0.2; share < 0.8; share += 0.01) {
    const double time_s = share * waypoints.back().time_s;
    const glm::dvec3 force_mps2 = trajectory.acceleration_mps2(time_s) - glm::dvec3(0, 0, kStandardGravity_mps2);
    const glm::dvec3 right = trajectory.world_from_body(time_s).rotation * glm::dvec3(0, 1, 0);
    CHECK(std::abs(dot(force_mps2, right)) < 2e-3 * kStandardGravity_mps2);  // smoothing over the spline's ripple
  }
}

TEST_CASE("the nose is along the velocity where the path neither stands still nor has corners") {
  for (const auto& waypoints : {circle(500, 60, 1.25, 1), loop(80, 60), climb_and_push_over()})
    for (const TrajectorySettings& settings : all_settings()) {
      INFO(name_of(settings));
      const Trajectory trajectory = trajectory_through(waypoints, settings);
      for (double time_s = -4; time_s < waypoints.back().time_s + 4; time_s += 0.0173) {
        const glm::dvec3 v_mps = trajectory.velocity_mps(time_s);
        CHECK(distance(nose_in_world(trajectory, time_s), v_mps / length(v_mps)) < 1e-14);  // rounding
      }
    }
}

TEST_CASE("a hovering intruder is level and looks along world X") {
  for (const TrajectorySettings& settings : all_settings())
    for (const double time_s : {-1e9, 0.0, 3.0, 1e9}) {
      const auto pose = trajectory_through({{3, {10, 20, -30}}}, settings).world_from_body(time_s);
      CHECK(rotation_between_rad(pose.rotation, {1, 0, 0, 0}) < 1e-12);
      CHECK(pose.translation_m == glm::dvec3(10, 20, -30));
    }
}

TEST_CASE("too slow to have a direction is level along world X at every time") {
  for (double last_s = 28; last_s < 33; last_s += 0.0137)  // however the ends of the time range are rounded
    for (const double time_s : {-100.0, 0.0, 10.0, last_s, last_s + 1.999, last_s + 2, last_s + 100}) {
      const Trajectory trajectory = trajectory_through({{-7.7, {0, 0, -30}}, {last_s, {0, 0, -30.5}}});
      CHECK(rotation_between_rad(trajectory.world_from_body(time_s).rotation, {1, 0, 0, 0}) < 1e-12);
    }
}

TEST_CASE("a straight line is flown level and straight up as if pitched up from world X") {
  const Attitude line = attitude_at(trajectory_through({{0, {0, 0, 0}}, {10, {300, 400, -100}}}), 4);
  CHECK(std::abs(line.roll_rad) < 1e-12);
  CHECK(line.pitch_rad == doctest::Approx(std::atan2(100, 500)).epsilon(1e-12));
  CHECK(line.yaw_rad == doctest::Approx(std::atan2(400, 300)).epsilon(1e-12));
  const glm::dquat up = trajectory_through({{0, {0, 0, 0}}, {10, {0, 0, -500}}}).world_from_body(4).rotation;
  CHECK(rotation_between_rad(up, rotation_of({0, std::numbers::pi / 2, 0})) < 1e-9);
}

TEST_CASE("a level reversal is turned through to the right in a fifth of a second") {
  const Trajectory trajectory = trajectory_through(reversal({300, 0, 0}));
  CHECK(distance(nose_in_world(trajectory, 3.89), {1, 0, 0}) < 1e-12);
  CHECK(distance(nose_in_world(trajectory, 4), {0, 1, 0}) < 1e-6);
  CHECK(distance(nose_in_world(trajectory, 4.11), {-1, 0, 0}) < 1e-12);
  for (const double time_s : {3.92, 4.0, 4.08}) CHECK(std::abs(attitude_at(trajectory, time_s).roll_rad) < 1e-6);
}

TEST_CASE("while standing still at the beginning the nose points in the direction of departure") {
  const glm::dvec3 start_m{0, 0, -100};
  const Trajectory trajectory =
      trajectory_through({{0, start_m}, {1, start_m}, {2, start_m}, {3, start_m}, {9, {0, 200, -100}}},
                         {.spline = SplineKind::approximating});
  CHECK(trajectory.velocity_mps(0) == glm::dvec3(0));
  CHECK(distance(nose_in_world(trajectory, -100), {0, 1, 0}) < 1e-12);
  CHECK(distance(nose_in_world(trajectory, 0), {0, 1, 0}) < 1e-12);
}

}  // namespace sigs
