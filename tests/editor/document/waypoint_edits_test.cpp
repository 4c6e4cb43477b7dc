// SPDX-License-Identifier: MIT
#include "editor/document/project_edits.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <random>

using namespace sigs;
using namespace sigs::editor;

namespace {

TrajectoryPlan plan_with(std::initializer_list<double> frames) {
  TrajectoryPlan plan;
  for (const double frame : frames) plan.waypoints.push_back({.frame = frame, .position_m = {frame, 0, 0}});
  return plan;
}

std::vector<double> frames_of(const TrajectoryPlan& plan) {
  std::vector<double> frames;
  for (const WaypointSettings& waypoint : plan.waypoints) frames.push_back(*waypoint.frame);
  return frames;
}

}  // namespace

TEST_CASE("a waypoint is inserted in order of time") {
  TrajectoryPlan plan = plan_with({0, 10, 20});
  CHECK(put_waypoint(plan, 15, {1, 2, 3}, frames_of(plan)) == 2);
  CHECK(frames_of(plan) == std::vector<double>{0, 10, 15, 20});
  CHECK(plan.waypoints[2].position_m == glm::dvec3(1, 2, 3));
  CHECK(put_waypoint(plan, -4, {0, 0, 0}, frames_of(plan)) == 0);
  CHECK(put_waypoint(plan, 99, {0, 0, 0}, frames_of(plan)) == 5);
  CHECK(frames_of(plan) == std::vector<double>{-4, 0, 10, 15, 20, 99});
}

TEST_CASE("a waypoint added at the frame of another moves that one") {
  TrajectoryPlan plan = plan_with({0, 10, 20});
  CHECK(put_waypoint(plan, 10, {7, 7, 7}, frames_of(plan)) == 1);
  CHECK(frames_of(plan) == std::vector<double>{0, 10, 20});
  CHECK(plan.waypoints[1].position_m == glm::dvec3(7, 7, 7));
}

TEST_CASE("the first waypoint of an empty trajectory") {
  TrajectoryPlan plan;
  CHECK(put_waypoint(plan, 5, {1, 0, 0}, {}) == 0);
  CHECK(frames_of(plan) == std::vector<double>{5});
}

TEST_CASE("waypoints spread in time stay where they were when one is added") {
  TrajectoryPlan plan;
  plan.waypoints.resize(3);
  CHECK(put_waypoint(plan, 25, {0, 0, 0}, {0, 50, 100}) == 1);
  CHECK(frames_of(plan) == std::vector<double>{0, 25, 50, 100});
}

TEST_CASE("the last waypoint cannot be deleted") {
  TrajectoryPlan plan = plan_with({0, 10});
  delete_waypoint(plan, 0, frames_of(plan));
  CHECK(frames_of(plan) == std::vector<double>{10});
  delete_waypoint(plan, 0, frames_of(plan));
  CHECK(plan.waypoints.size() == 1);
  delete_waypoint(plan, 9, frames_of(plan));
  delete_waypoint(plan, -1, frames_of(plan));
  CHECK(plan.waypoints.size() == 1);
}

TEST_CASE("a copy lies between the waypoint and the next, or beyond the last by the last interval") {
  TrajectoryPlan plan = plan_with({0, 10, 20});
  CHECK(duplicate_waypoint(plan, 0, frames_of(plan)) == 1);
  CHECK(frames_of(plan) == std::vector<double>{0, 5, 10, 20});
  CHECK(plan.waypoints[1].position_m.x == 5);
  CHECK(duplicate_waypoint(plan, 3, frames_of(plan)) == 4);
  CHECK(*plan.waypoints[4].frame == 30);
  CHECK(plan.waypoints[4].position_m.x == 30);
}

TEST_CASE("between neighbours one frame apart no copy is possible") {
  TrajectoryPlan plan = plan_with({0, 1});
  CHECK(duplicate_waypoint(plan, 0, frames_of(plan)) == 0);
  CHECK(plan.waypoints.size() == 2);
}

TEST_CASE("a waypoint dragged in time stops at its neighbours") {
  TrajectoryPlan plan = plan_with({0, 10, 20});
  move_waypoint_in_time(plan, 1, 500, frames_of(plan));
  CHECK(*plan.waypoints[1].frame == 19);
  move_waypoint_in_time(plan, 1, -500, frames_of(plan));
  CHECK(*plan.waypoints[1].frame == 1);
  move_waypoint_in_time(plan, 1, std::numeric_limits<double>::quiet_NaN(), frames_of(plan));
  CHECK(*plan.waypoints[1].frame == 1);
}

TEST_CASE("after any edit waypoints are in order of time") {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> any(-50, 250);
  TrajectoryPlan plan = plan_with({0, 60, 199});
  for (int i = 0; i < 2000; ++i) {
    const int which = static_cast<int>(random() % (plan.waypoints.size() + 2)) - 1;
    switch (random() % 4) {
      case 0:
        (void)put_waypoint(plan, any(random), {0, 0, 0}, frames_of(plan));
        break;
      case 1:
        delete_waypoint(plan, which, frames_of(plan));
        break;
      case 2:
        (void)duplicate_waypoint(plan, which, frames_of(plan));
        break;
      default:
        move_waypoint_in_time(plan, which, any(random), frames_of(plan));
    }
    if (plan.waypoints.size() > 40) plan.waypoints.resize(5);
    const std::vector<double> frames = frames_of(plan);
    REQUIRE_FALSE(frames.empty());
    for (std::size_t j = 1; j < frames.size(); ++j) REQUIRE(frames[j] - frames[j - 1] >= kMinGap_frames - 1e-9);
  }
}
