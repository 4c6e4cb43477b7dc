// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "base/pose.h"
#include "flights.h"
#include "spline/trajectory.h"

namespace sigs {

using namespace test;

namespace {

constexpr double kOneG_mps2 = 9.80665;
constexpr double kDegree = std::numbers::pi / 180;

Attitude carried_attitude(const Trajectory& trajectory, double time_s) {
  return attitude_of(trajectory.world_from_body(time_s).rotation);
}

// Waypoints along X at one acceleration, from rest, each half second.
std::vector<TimedWaypoint> from_rest(double acceleration_mps2, double duration_s) {
  std::vector<TimedWaypoint> waypoints;
  for (int i = 0; i <= std::lround(2 * duration_s); ++i)
    waypoints.push_back({0.5 * i, {0.125 * acceleration_mps2 * i * i, 0, -100}});
  return waypoints;
}

std::vector<TimedWaypoint> straight_at(double speed_mps, double duration_s) {
  return {{0, {0, 0, -100}}, {duration_s, {speed_mps * duration_s, 0, -100}}};
}

}  // namespace

TEST_CASE("a helicopter hovers level at any heading") {
  const Trajectory trajectory =
      trajectory_through({{3, {1, 2, -30}}}, {.attitude = AttitudeKind::helicopter, .headings = {{3, 2.5}}});
  for (const double time_s : {-1e6, 0.0, 3.0, 1e6}) {
    const Attitude attitude = carried_attitude(trajectory, time_s);
    CHECK(attitude.yaw_rad == doctest::Approx(2.5));
    CHECK(attitude.pitch_rad == doctest::Approx(0));
    CHECK(attitude.roll_rad == doctest::Approx(0));
  }
}

TEST_CASE("at a steady speed the nose is down by the drag, and a balloon stays level") {
  const Trajectory helicopter = trajectory_through(straight_at(60, 20), {.attitude = AttitudeKind::helicopter});
  CHECK(carried_attitude(helicopter, 10).pitch_rad ==
        doctest::Approx(-std::atan(2.4e-4 * 3600 / kOneG_mps2)).epsilon(1e-6));
  const Trajectory multirotor = trajectory_through(straight_at(15, 20), {.attitude = AttitudeKind::multirotor});
  CHECK(carried_attitude(multirotor, 10).pitch_rad == doctest::Approx(-24.6 * kDegree).epsilon(0.01));
  const Trajectory balloon = trajectory_through(from_rest(3, 10), {.attitude = AttitudeKind::balloon});
  CHECK(carried_attitude(balloon, 5).pitch_rad == 0);
  CHECK(carried_attitude(balloon, 5).roll_rad == 0);
}

TEST_CASE("the up axis lies along acceleration less gravity and drag, whatever the heading") {
  for (const double heading_rad : {0.0, 1.0, -2.5})
    for (const int side : {1, -1}) {
      const auto waypoints = circle(200, 30, 1.25, side);
      const Trajectory trajectory = trajectory_through(
          waypoints, {.attitude = AttitudeKind::helicopter, .headings = {{waypoints.front().time_s, heading_rad}}});
      const double middle_s = 0.5 * (waypoints.front().time_s + waypoints.back().time_s);
      constexpr double kStep_s = 1e-2;
      const glm::dvec3 before = trajectory.position_m(middle_s - kStep_s);
      const glm::dvec3 there = trajectory.position_m(middle_s);
      const glm::dvec3 after = trajectory.position_m(middle_s + kStep_s);
      const glm::dvec3 velocity = (after - before) / (2 * kStep_s);
      const glm::dvec3 acceleration = (after - 2.0 * there + before) / (kStep_s * kStep_s);
      const glm::dvec3 thrust = acceleration - glm::dvec3(0, 0, kOneG_mps2) + 2.4e-4 * glm::length(velocity) * velocity;
      const glm::dquat world_from_body = trajectory.world_from_body(middle_s).rotation;
      const glm::dvec3 up = world_from_body * glm::dvec3(0, 0, -1);
      // Smoothing over half a second flattens a tilt that turns around the heading by 9 degrees a second.
      CHECK(glm::dot(up, glm::normalize(thrust)) > std::cos(0.6 * kDegree));
      CHECK(attitude_of(world_from_body).yaw_rad == doctest::Approx(heading_rad));
    }
}

TEST_CASE("it puts its nose down to accelerate and up to slow down") {
  const Trajectory faster = trajectory_through(from_rest(3, 12), {.attitude = AttitudeKind::helicopter});
  CHECK(carried_attitude(faster, 2).pitch_rad == doctest::Approx(-std::atan(3 / kOneG_mps2)).epsilon(0.02));
  std::vector<TimedWaypoint> braking = from_rest(3, 12);
  for (TimedWaypoint& waypoint : braking) waypoint.time_s = 12 - waypoint.time_s;
  std::reverse(braking.begin(), braking.end());  // towards the origin, tail to the way it came
  const Trajectory slower = trajectory_through(braking, {.attitude = AttitudeKind::helicopter});
  CHECK(carried_attitude(slower, 10).pitch_rad == doctest::Approx(std::atan(3 / kOneG_mps2)).epsilon(0.02));
  CHECK(std::abs(carried_attitude(slower, 10).yaw_rad) == doctest::Approx(std::numbers::pi));
}

TEST_CASE("headings are reached by the shorter way, and the path's is held where it has none") {
  const std::vector<TimedWaypoint> hover = {{0, {0, 0, -9}}, {10, {0, 0, -9}}};
  const Trajectory turning = trajectory_through(
      hover, {.attitude = AttitudeKind::multirotor, .headings = {{0, 170 * kDegree}, {10, -170 * kDegree}}});
  CHECK(std::abs(carried_attitude(turning, 5).yaw_rad) == doctest::Approx(std::numbers::pi).epsilon(1e-3));
  const std::vector<TimedWaypoint> lift = {{0, {0, 0, 0}}, {10, {0, 100, 0}}, {20, {0, 200, 0}}, {40, {0, 200, -300}}};
  const Trajectory lifted = trajectory_through(lift, {.attitude = AttitudeKind::helicopter});
  for (const double time_s : {10.0, 30.0, 38.0}) {
    const glm::dvec3 nose = lifted.world_from_body(time_s).rotation * glm::dvec3(1, 0, 0);
    CHECK(std::abs(nose.y) > 0.85);  // along Y, forwards or, where the path swings back, backwards
    CHECK(std::abs(nose.z) < 0.5);   // not up, though the path is
  }
}

TEST_CASE("extreme paths tilt it no further than the limit, and everything stays a number") {
  const std::vector<TimedWaypoint> wild = {{0, {0, 0, 0}}, {1e-3, {1e7, 0, 0}}, {1, {0, 1e7, 1e7}}, {1e5, {0, 0, 0}}};
  const std::vector<TimedWaypoint> falling = {
      {0, {0, 0, -1000}}, {1, {0, 0, -995}}, {2, {0, 0, -980}}, {9, {0, 0, -10}}};
  for (const auto& waypoints : {wild, falling})
    for (const AttitudeKind kind : {AttitudeKind::helicopter, AttitudeKind::multirotor, AttitudeKind::balloon}) {
      const Trajectory trajectory = trajectory_through(waypoints, {.attitude = kind, .bank_limit_rad = 30 * kDegree});
      for (double time_s = -1; time_s < 11; time_s += 0.01) {
        const Attitude attitude = carried_attitude(trajectory, time_s);
        REQUIRE(std::isfinite(attitude.yaw_rad));
        REQUIRE(std::abs(attitude.pitch_rad) < 31 * kDegree);
        REQUIRE(std::abs(attitude.roll_rad) < 31 * kDegree);
      }
    }
}

TEST_CASE("headings that are no numbers or not in the order of time are refused") {
  const std::vector<TimedWaypoint> waypoints = straight_at(10, 10);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const std::vector<TimedHeading>& headings :
       {std::vector<TimedHeading>{{0, nan}}, {{nan, 0}}, {{1, 0}, {1, 1}}, {{2, 0}, {1, 0}}}) {
    const Result<Trajectory> made =
        Trajectory::make(waypoints, {.attitude = AttitudeKind::helicopter, .headings = headings});
    REQUIRE_FALSE(made.has_value());
    CHECK(made.error().where == "headings");
  }
}

}  // namespace sigs
