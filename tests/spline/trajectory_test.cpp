// SPDX-License-Identifier: MIT

#include <doctest/doctest.h>
#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "flights.h"
#include "spline/trajectory.h"

namespace sigs {

using namespace test;

namespace {

Error refusal_of(const std::vector<TimedWaypoint>& waypoints, const TrajectorySettings& settings = {}) {
  const Result<Trajectory> trajectory = Trajectory::make(waypoints, settings);
  REQUIRE(!trajectory.has_value());
  return trajectory.error();
}

std::vector<double> bytes_of(const Trajectory& trajectory, double time_s) {
  const auto pose = trajectory.world_from_body(time_s);
  const glm::dvec3 v = trajectory.velocity_mps(time_s);
  const glm::dvec3 a = trajectory.acceleration_mps2(time_s);
  const glm::dvec3 p = pose.translation_m;
  const glm::dquat q = pose.rotation;
  return {p.x, p.y, p.z, v.x, v.y, v.z, a.x, a.y, a.z, q.w, q.x, q.y, q.z};
}

}  // namespace

TEST_CASE("velocity and acceleration are what central differences of the position give") {
  const double step_s = 1e-4;
  for (const SplineKind spline : {SplineKind::interpolating, SplineKind::approximating}) {
    const auto waypoints = wild(12, 31);
    const Trajectory trajectory = trajectory_through(waypoints, {.spline = spline});
    for (double time_s = 0.0123; time_s < waypoints.back().time_s; time_s += 0.0317) {
      const glm::dvec3 before_m = trajectory.position_m(time_s - step_s);
      const glm::dvec3 here_m = trajectory.position_m(time_s);
      const glm::dvec3 after_m = trajectory.position_m(time_s + step_s);
      // Jerks here are under 1e4 m/s^3: step^2 / 6 and, over a knot, step / 6 of that; rounding 1e-13 / step^2 = 1e-5.
      CHECK(distance(trajectory.velocity_mps(time_s), (after_m - before_m) / (2 * step_s)) < 1e-4);
      CHECK(distance(trajectory.acceleration_mps2(time_s), (after_m - 2.0 * here_m + before_m) / (step_s * step_s)) <
            0.5);
    }
  }
}

TEST_CASE("position is the pose's translation and passes through the waypoints far from the origin") {
  auto waypoints = wild(20, 32);
  for (TimedWaypoint& w : waypoints) w.position_m += glm::dvec3(1e7, -1e7, -1e7);
  const Trajectory trajectory = trajectory_through(waypoints);
  for (const TimedWaypoint& w : waypoints) {
    CHECK(distance(trajectory.position_m(w.time_s), w.position_m) < 1e-9);
    CHECK(trajectory.world_from_body(w.time_s).translation_m == trajectory.position_m(w.time_s));
  }
}

TEST_CASE("far from the origin the attitude is the same") {
  const auto near = wild(10, 33);
  auto far = near;
  for (TimedWaypoint& w : far) w.position_m += glm::dvec3(1e7, -1e7, -1e7);
  const Trajectory a = trajectory_through(near);
  const Trajectory b = trajectory_through(far);
  for (double time_s = -1; time_s < near.back().time_s; time_s += 0.1)
    CHECK(rotation_between_rad(a.world_from_body(time_s).rotation, b.world_from_body(time_s).rotation) < 1e-5);
}

TEST_CASE("everything depends on the time alone and not on the order of the calls") {
  for (const TrajectorySettings& settings : all_settings()) {
    const auto waypoints = wild(10, 34);
    const Trajectory trajectory = trajectory_through(waypoints, settings);
    const Trajectory again = trajectory_through(waypoints, settings);
    std::vector<double> times_s;
    for (double time_s = -3; time_s < waypoints.back().time_s + 3; time_s += 0.0371) times_s.push_back(time_s);
    std::vector<std::vector<double>> in_order;
    for (const double time_s : times_s) in_order.push_back(bytes_of(trajectory, time_s));
    std::vector<std::size_t> order(times_s.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    std::shuffle(order.begin(), order.end(), std::mt19937(1));
    bool same = true;
    for (const std::size_t i : order)
      same = same && bytes_of(trajectory, times_s[i]) == in_order[i] && bytes_of(again, times_s[i]) == in_order[i];
    CHECK(same);
  }
}

TEST_CASE("ten thousand waypoints are flown") {
  const auto waypoints = wild(10000, 35);
  for (const Timing timing : {Timing::frames, Timing::constant_speed}) {
    const Trajectory trajectory = trajectory_through(waypoints, {.timing = timing});
    const double last_s = waypoints.back().time_s;
    CHECK(distance(trajectory.position_m(last_s), waypoints.back().position_m) < 1e-9);
    for (double share = 0; share <= 1; share += 0.001)
      CHECK(std::isfinite(trajectory.world_from_body(share * last_s).rotation.w));
  }
}

TEST_CASE("legs of one frame and of a hundred thousand frames can be combined") {
  const std::vector<TimedWaypoint> waypoints{{0, {0, 0, -100}},
                                             {0.04, {2, 0, -100}},
                                             {4000.04, {9000, 500, -200}},
                                             {4000.08, {9002, 500, -200}},
                                             {8000.08, {0, 900, -200}}};
  for (const TrajectorySettings& settings : all_settings()) {
    INFO(name_of(settings));
    const Trajectory trajectory = trajectory_through(waypoints, settings);
    for (double time_s = -10; time_s < 8100; time_s += 1.37) {
      const auto pose = trajectory.world_from_body(time_s);
      CHECK(std::abs(length(pose.rotation) - 1) < 1e-14);
      CHECK(length(pose.translation_m) < 1e6);
    }
    if (settings.spline == SplineKind::interpolating && settings.timing == Timing::frames)
      for (const TimedWaypoint& w : waypoints) CHECK(distance(trajectory.position_m(w.time_s), w.position_m) < 1e-9);
  }
}

TEST_CASE("numbers at the allowed limits give finite numbers") {
  for (const TrajectorySettings& settings : all_settings())
    for (const double extent_m : {1e-300, 1e-9, 1e12}) {
      INFO(name_of(settings) << " " << extent_m);
      const std::vector<TimedWaypoint> waypoints{{-1e12, {0, 0, 0}},
                                                 {0, {extent_m, 0, 0}},
                                                 {1e-9, {0, extent_m, 0}},
                                                 {1, {0, 0, -extent_m}},
                                                 {1e12, {0, 0, 0}}};
      const Trajectory trajectory = trajectory_through(waypoints, settings);
      for (const double time_s : {-2e12, -1e12, -5.0, 0.0, 5e-10, 1e-9, 0.5, 1.0, 1e6, 1e12, 2e12})
        CHECK(std::abs(length(trajectory.world_from_body(time_s).rotation) - 1) < 1e-14);
    }
}

TEST_CASE("errors in the waypoints are reported") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double inf = std::numeric_limits<double>::infinity();
  const std::vector<TimedWaypoint> good{{0, {0, 0, 0}}, {1, {1, 0, 0}}, {2, {2, 0, 0}}, {3, {3, 0, 0}}};
  CHECK(refusal_of({}).where == "waypoints");
  for (const double bad : {nan, inf, -inf, 1e13}) {
    for (int axis = 0; axis < 3; ++axis) {
      auto waypoints = good;
      waypoints[3].position_m[axis] = bad;
      CHECK(refusal_of(waypoints).where == "waypoints[3]");
      CHECK(refusal_of(waypoints).kind == ErrorKind::bad_project);
    }
    for (const std::size_t i : {0U, 2U}) {
      auto waypoints = good;
      waypoints[i].time_s = bad;
      CHECK(refusal_of(waypoints).where == "waypoints[" + std::to_string(i) + "]");
    }
  }
  for (const double late_s : {1.0, 0.5, -3.0}) {
    auto waypoints = good;
    waypoints[2].time_s = late_s;
    const Error error = refusal_of(waypoints);
    CHECK(error.where == "waypoints[2]");
    CHECK(error.what.find("later") != std::string::npos);
    CHECK(error.what.find('\n') == std::string::npos);
  }
  CHECK(refusal_of(good, {.bank_limit_rad = nan}).where == "bank_limit");
}

TEST_CASE("a copy of a trajectory is the same flight") {
  const Trajectory trajectory = trajectory_through(wild(5, 36));
  const Trajectory copy = trajectory;
  CHECK(bytes_of(copy, 1.5) == bytes_of(trajectory, 1.5));
}

}  // namespace sigs
