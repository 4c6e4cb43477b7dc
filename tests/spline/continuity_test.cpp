// SPDX-License-Identifier: MIT

#include <doctest/doctest.h>
#include <algorithm>
#include <cmath>

#include "flights.h"
#include "spline/attitude.h"
#include "spline/trajectory.h"

namespace sigs {

using namespace test;

namespace {

struct Step {
  double from_s = 0;
  double to_s = 0;
  double rotation_rad = 0;
};

Step step_of(const Trajectory& trajectory, double from_s, double to_s) {
  return {from_s, to_s,
          rotation_between_rad(trajectory.world_from_body(from_s).rotation, trajectory.world_from_body(to_s).rotation)};
}

// The rotation within ever shorter parts of a step: it tends to zero, except at a jump.
Step at_its_worst(const Trajectory& trajectory, Step step) {
  for (int halving = 0; halving < 24; ++halving) {
    const double middle_s = step.from_s + (step.to_s - step.from_s) / 2;
    const Step first = step_of(trajectory, step.from_s, middle_s);
    const Step second = step_of(trajectory, middle_s, step.to_s);
    step = first.rotation_rad > second.rotation_rad ? first : second;
  }
  return step;
}

std::vector<Step> steps_over(const Trajectory& trajectory, double first_s, double last_s, double length_s) {
  std::vector<Step> steps;
  for (double time_s = first_s; time_s < last_s; time_s += length_s)
    steps.push_back(step_of(trajectory, time_s, time_s + length_s));
  return steps;
}

void check_continuous(const Trajectory& trajectory, double first_s, double last_s) {
  std::vector<Step> steps = steps_over(trajectory, first_s, last_s, 0.002);
  std::ranges::sort(steps, [](const Step& a, const Step& b) { return a.rotation_rad > b.rotation_rad; });
  CHECK(steps.front().rotation_rad < 0.2);  // 100 rad/s; a corner's finest turn is 70, roll and all
  const std::size_t worst = std::min<std::size_t>(steps.size(), 40);
  for (std::size_t i = 0; i < worst; ++i)
    CHECK(at_its_worst(trajectory, steps[i]).rotation_rad < 1e-6);  // 100 rad/s in 1e-10 s is 1e-8
}

}  // namespace

TEST_CASE("attitude is continuous through every feature that a path can have") {
  for (const Flight& flight : all_flights())
    for (const TrajectorySettings& settings : all_settings()) {
      INFO(flight.name << ", " << name_of(settings));
      check_continuous(trajectory_through(flight.waypoints, settings), flight.waypoints.front().time_s - 3,
                       flight.waypoints.back().time_s + 3);
    }
}

TEST_CASE("attitude is continuous in many wild flights") {
  for (unsigned seed = 100; seed < 130; ++seed) {
    INFO(seed);
    const auto waypoints = wild(6, seed);
    const auto settings = all_settings()[seed % 8];
    check_continuous(trajectory_through(waypoints, settings), -1, waypoints.back().time_s + 1);
  }
}

TEST_CASE("two reversals close together are both turned through") {
  // Velocity along X is 0.01 (s - 102) (s - 108): backward for 6 s in a piece of 320 s, between two of its 32 first
  // samples, and so gently that the force does not show it.
  const CubicPiece piece{{{0, 0, 0}, {110.16, 0, 0}, {-1.05, 0, 0}, {0.01 / 3, 0, 0}}};
  const PiecewiseCubic curve({0, 320}, {piece}, {320 * 110.16 - 320 * 320 * 1.05 + 320 * 320 * 320 * 0.01 / 3, 0, 0});
  const AttitudeTable attitude(curve, Bank::coordinated, 1);
  const auto nose_at = [&](double time_s) {
    return attitude.world_from_body(time_s, curve.motion_at(time_s).velocity_mps) * glm::dvec3(1, 0, 0);
  };
  CHECK(distance(nose_at(101), {1, 0, 0}) < 1e-12);
  CHECK(distance(nose_at(105), {-1, 0, 0}) < 1e-12);
  CHECK(distance(nose_at(109), {1, 0, 0}) < 1e-12);
  for (double time_s = 100; time_s < 110; time_s += 1e-4)
    CHECK(distance(nose_at(time_s), nose_at(time_s + 1e-4)) < 24 * 1e-4);  // pi in 0.2 s, half as fast again half-way
}

TEST_CASE("a fast loop and a push-over turn no faster than their paths require") {
  const auto fastest_radps = [](const std::vector<TimedWaypoint>& waypoints, const TrajectorySettings& settings) {
    const Trajectory trajectory = trajectory_through(waypoints, settings);
    double max_rad = 0;
    for (const Step& step : steps_over(trajectory, -1, waypoints.back().time_s + 1, 0.002))
      max_rad = std::max(max_rad, step.rotation_rad);
    return max_rad / 0.002;
  };
  CHECK(fastest_radps(loop(80, 60), {}) <
        1.2);  // 60 m/s over 80 m is 0.75 rad/s; the spline overshoots in and out of it
  // Wings level right through the vertical means half a roll there, smoothed over 0.15 s: pi / 2 / 0.15 = 10.5 rad/s.
  CHECK(fastest_radps(loop(80, 60), {.bank = Bank::level}) < 12);
  CHECK(fastest_radps(climb_and_push_over(), {}) < 12);
}

TEST_CASE("nothing is ever NaN and rotations are unit quaternions") {
  for (const Flight& flight : all_flights())
    for (const TrajectorySettings& settings : all_settings()) {
      INFO(flight.name << ", " << name_of(settings));
      const Trajectory trajectory = trajectory_through(flight.waypoints, settings);
      std::vector<double> times_s{-1e9, 1e9};
      for (const TimedWaypoint& w : flight.waypoints) times_s.push_back(w.time_s);
      for (double time_s = -3; time_s < flight.waypoints.back().time_s + 3; time_s += 0.0917) times_s.push_back(time_s);
      for (const double time_s : times_s) {
        const auto pose = trajectory.world_from_body(time_s);
        CHECK(std::abs(length(pose.rotation) - 1) < 1e-14);  // false for NaN
        CHECK(is_finite(pose.translation_m));
        CHECK(is_finite(trajectory.velocity_mps(time_s)));
        CHECK(is_finite(trajectory.acceleration_mps2(time_s)));
      }
    }
}

}  // namespace sigs
